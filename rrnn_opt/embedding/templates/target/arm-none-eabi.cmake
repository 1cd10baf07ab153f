# Cross build for a bare Cortex-M:
#   cmake -B build -DCMAKE_TOOLCHAIN_FILE=cmake/arm-none-eabi.cmake -DCPU=cortex-m7
set(CMAKE_SYSTEM_NAME Generic)
set(CMAKE_SYSTEM_PROCESSOR arm)
set(CMAKE_C_COMPILER arm-none-eabi-gcc)
set(CMAKE_TRY_COMPILE_TARGET_TYPE STATIC_LIBRARY)
set(CPU "cortex-m4f" CACHE STRING "cortex-m4f (single-precision unit) or cortex-m7 (double)")
if(CPU STREQUAL "cortex-m7")
  set(cpu_flags "-mcpu=cortex-m7 -mfpu=fpv5-d16")
else()
  set(cpu_flags "-mcpu=cortex-m4 -mfpu=fpv4-sp-d16")
endif()
# The parameter takes conditional moves in place of branches: the number of
# instructions of a step then does not depend on the data.
set(CMAKE_C_FLAGS_INIT "${cpu_flags} -mthumb -mfloat-abi=hard -ffp-contract=off -fno-math-errno -ffunction-sections -fdata-sections --param=max-rtl-if-conversion-unpredictable-cost=100")
