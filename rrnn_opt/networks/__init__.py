"""Networks: rules with hyper-parameters only that turn a formulation into dynamics."""

from rrnn_opt.networks.memory_cell import MemoryCell
from rrnn_opt.networks.primal_dual import PrimalDual

__all__ = ["MemoryCell", "PrimalDual"]
