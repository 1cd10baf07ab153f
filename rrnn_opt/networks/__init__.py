"""Networks: rules with hyper-parameters only that turn a formulation into dynamics."""

from rrnn_opt.networks.dual_network import DualNetwork
from rrnn_opt.networks.e47 import E47
from rrnn_opt.networks.finite_time_znn import FiniteTimeZnn
from rrnn_opt.networks.hildreth import Hildreth
from rrnn_opt.networks.lvi94 import Lvi94
from rrnn_opt.networks.lvi_pdnn import LviPdnn
from rrnn_opt.networks.memory_cell import MemoryCell
from rrnn_opt.networks.network import Needs, Network
from rrnn_opt.networks.noise_tolerant_znn import NoiseTolerantZnn
from rrnn_opt.networks.primal_dual import PrimalDual
from rrnn_opt.networks.simplified_lvi_pdnn import SimplifiedLviPdnn
from rrnn_opt.networks.varying_gain_znn import VaryingGainZnn
from rrnn_opt.networks.znn import Znn

__all__ = [
    "E47",
    "DualNetwork",
    "FiniteTimeZnn",
    "Hildreth",
    "Lvi94",
    "LviPdnn",
    "MemoryCell",
    "Needs",
    "Network",
    "NoiseTolerantZnn",
    "PrimalDual",
    "SimplifiedLviPdnn",
    "VaryingGainZnn",
    "Znn",
]
