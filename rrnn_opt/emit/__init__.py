"""From a symbolic function to clean C99, and to compiled code on this machine."""

from rrnn_opt.emit.batch import Batch, compile_batch
from rrnn_opt.emit.c99 import c_function
from rrnn_opt.emit.compiler import Compiler, find_compiler
from rrnn_opt.emit.host import Built, build, load
from rrnn_opt.emit.program import Program, compile
from rrnn_opt.emit.prologue import Real, prologue

__all__ = [
    "Batch",
    "Built",
    "Compiler",
    "Program",
    "Real",
    "build",
    "c_function",
    "compile",
    "compile_batch",
    "find_compiler",
    "load",
    "prologue",
]
