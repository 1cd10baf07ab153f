"""Arguments are of the kind that a signature says, or one sentence says which not.

``@checked`` stands on the constructors and verbs that users call.  It reads the
annotations once and looks at the kind alone: a number, a whole number, a text,
rows of numbers, an object of a class.  What values mean is for those who take
them; but no number that a checked dataclass keeps is NaN, nor infinite unless
its default is or it is named.
"""

from rrnn_opt.arguments.checked import checked
from rrnn_opt.arguments.require import require_numeric, require_parts

__all__ = ["checked", "require_numeric", "require_parts"]
