"""The head of every emitted translation unit: types, macros, support code.

Support headers are inlined, so that a translation unit stands alone: the text
is the whole truth that a cache key or a reader needs.
"""

from __future__ import annotations

from collections.abc import Sequence
from importlib import resources
from typing import Final, Literal

from rrnn_opt.errors import RrnnError

Real = Literal["double", "float"]
Trig = Literal["own", "libm"]
SUFFIX: Final[dict[str, str]] = {"double": "", "float": "F"}

_HEAD = """\
#include <float.h>
#include <math.h>
#include <stddef.h>
#include <stdint.h>

typedef {real} real_t;
#define RRNN_C(literal) {literal}
#define RRNN_SQRT(x) sqrt{f}(x)
#define RRNN_FABS(x) fabs{f}(x)
#if defined(__GNUC__)
#define RRNN_UNUSED __attribute__((unused))
#define RRNN_EXPORT __attribute__((visibility("default")))
#define RRNN_INLINE static inline __attribute__((always_inline))
#define RRNN_APART __attribute__((noinline))
#else
#define RRNN_UNUSED
#define RRNN_EXPORT
#define RRNN_INLINE static inline
#define RRNN_APART
#endif
"""

_LIBRARY_SINCOS = """\
typedef struct {{
    real_t s;
    real_t c;
}} rrnn_sincos_t;

RRNN_UNUSED static inline rrnn_sincos_t rrnn_sincos(real_t x)
{{
    const rrnn_sincos_t out = {{sin{f}(x), cos{f}(x)}};
    return out;
}}

RRNN_UNUSED static void rrnn_sincos_all(const real_t x[], uint32_t count,
                                        rrnn_sincos_t out[])
{{
    uint32_t i;
    for (i = 0U; i < count; ++i) {{
        out[i] = rrnn_sincos(x[i]);
    }}
}}
"""


def prologue(
    real: Real = "double",
    *,
    support: Sequence[str] = (),
    compact: bool = False,
    trig: Trig = "own",
) -> str:
    """Text that opens a translation unit.

    It defines ``real_t``, ``RRNN_C(0.5)`` (a literal of that type),
    ``RRNN_SQRT``, ``RRNN_FABS``, ``RRNN_UNUSED``, ``RRNN_EXPORT``, ``RRNN_INLINE``,
    ``rrnn_sincos_t`` and ``rrnn_sincos``.

    Args:
        real: C type of ``real_t``.
        support: further headers of ``emit/support`` to inline, in this order,
            e.g. ``("hildreth.h",)``.
        compact: sine and cosine of the same bits for a microcontroller: small,
            and always the same number of instructions.
        trig: "own" sine and cosine, defined to the bit, or "libm", those of
            the C library.

    Returns:
        C99 text without dependencies other than the standard headers.
    """
    literal = "literal##F" if require_real(real) == "float" else "literal"
    suffix = "f" if real == "float" else ""
    head = _HEAD.format(real=real, literal=literal, f=suffix)
    if require_trig(trig) == "libm":
        parts = [_LIBRARY_SINCOS.format(f=suffix)]
    else:
        parts = [support_text(f"{'compact' if compact else 'sincos'}_{real}.h")]
    parts += [support_text(name) for name in support]
    return "\n".join([head, *parts])


def support_text(name: str) -> str:
    """Text of one header in ``emit/support``.

    Raises:
        RrnnError: there is no such header.
    """
    try:
        return (resources.files("rrnn_opt.emit") / "support" / name).read_text("utf-8")
    except FileNotFoundError as error:
        raise RrnnError(f"no support header named '{name}'") from error


def require_real(real: str) -> str:
    """Return ``real`` if it names a C type that the emitter knows.

    Raises:
        RrnnError: it names none.
    """
    if real not in SUFFIX:
        raise RrnnError(f"real must be 'double' or 'float', got '{real}'")
    return real


def require_trig(trig: str) -> str:
    """Return ``trig`` if it names a sine and cosine that the emitter knows.

    Raises:
        RrnnError: it names none.
    """
    if trig not in ("own", "libm"):
        raise RrnnError(f"sine and cosine must be 'own' or 'libm', got '{trig}'")
    return trig
