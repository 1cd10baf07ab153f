"""Flags of the planner's build."""

from rrnn_opt.planning.search import flags


def test_flags_are_those_that_a_compiler_and_a_cpu_know():
    with_masks, without = "x86_64 avx2 avx512f", "x86_64 avx2"
    assert flags.build_flags("clang", without) == flags.FLAGS
    gcc = flags.build_flags("gcc", with_masks)
    assert gcc == flags.FLAGS + flags.GCC_FLAGS
    assert flags.build_flags("gcc", without) == gcc + flags.UNMASKED_FLAGS
