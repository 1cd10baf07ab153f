/* The boards MPS2 AN386 (Cortex-M4F) and AN500 (Cortex-M7), as QEMU has them, with
 * Arm semihosting for text and files.
 *
 * Counting: under `-icount shift=6` an instruction lasts 64 ns; timer 0 ticks
 * every 40 ns. So these are instructions, not cycles: no pipeline, no flash
 * wait states, no cache. */
#include "board.h"

#define TIMER_CONTROL (*(volatile uint32_t *)0x40000000U)
#define TIMER_VALUE (*(volatile uint32_t *)0x40000004U)
#define TIMER_RELOAD (*(volatile uint32_t *)0x40000008U)

enum { SYS_OPEN = 0x01, SYS_CLOSE = 0x02, SYS_WRITE0 = 0x04, SYS_WRITE = 0x05,
       SYS_READ = 0x06, SYS_EXIT_EXTENDED = 0x20 };

static uint32_t call(uint32_t operation, const void *argument)
{
    register uint32_t r0 __asm("r0") = operation;
    register const void *r1 __asm("r1") = argument;
    __asm volatile("bkpt 0xAB" : "+r"(r0) : "r"(r1) : "memory");
    return r0;
}

static uint32_t address(const void *pointer)
{
    return (uint32_t)(uintptr_t)pointer;
}

void board_text(const char *text)
{
    (void)call(SYS_WRITE0, text);
}

void board_number(uint32_t value)
{
    char text[11];
    size_t at = sizeof text - 1U;
    text[at] = '\0';
    do {
        --at;
        text[at] = (char)('0' + (char)(value % 10U));
        value /= 10U;
    } while (value != 0U);
    board_text(&text[at]);
}

void board_bits32(uint32_t value)
{
    static const char digit[] = "0123456789abcdef";
    char text[9];
    size_t k;
    for (k = 0U; k < 8U; ++k) {
        text[k] = digit[(value >> (28U - 4U * k)) & 0xFU];
    }
    text[8] = '\0';
    board_text(text);
}

void board_bits64(uint64_t value)
{
    board_bits32((uint32_t)(value >> 32));
    board_bits32((uint32_t)value);
}

static size_t length(const char *text)
{
    size_t count = 0U;
    while (text[count] != '\0') {
        ++count;
    }
    return count;
}

int board_open(const char *name, const char *mode)
{
    const uint32_t block[3] = {address(name), (mode[0] == 'w') ? 5U : 1U,
                               (uint32_t)length(name)};
    return (int)call(SYS_OPEN, block);
}

int board_read(int file, void *bytes, size_t count)
{
    const uint32_t block[3] = {(uint32_t)file, address(bytes), (uint32_t)count};
    return (call(SYS_READ, block) == 0U) ? 1 : 0;
}

int board_write(int file, const void *bytes, size_t count)
{
    const uint32_t block[3] = {(uint32_t)file, address(bytes), (uint32_t)count};
    return (call(SYS_WRITE, block) == 0U) ? 1 : 0;
}

void board_close(int file)
{
    const uint32_t block[1] = {(uint32_t)file};
    (void)call(SYS_CLOSE, block);
}

void board_count_begin(void)
{
    TIMER_CONTROL = 0U;
    TIMER_RELOAD = 0xFFFFFFFFU;
    TIMER_VALUE = 0xFFFFFFFFU;
    TIMER_CONTROL = 1U;
}

uint32_t board_count(void)
{
    const uint64_t ticks = 0xFFFFFFFFU - TIMER_VALUE;
    return (uint32_t)((ticks * 5U) / 8U);
}

void board_exit(int status)
{
    const uint32_t block[2] = {0x20026U, (uint32_t)status};
    (void)call(SYS_EXIT_EXTENDED, block);
    for (;;) {
    }
}
