"""What MANIFEST.json says of a package."""

from __future__ import annotations

from dataclasses import asdict
from importlib import metadata
from typing import Any

from rrnn_opt.embedding.kernel import Field, Kernel
from rrnn_opt.embedding.options import Options


def facts(core: Kernel, options: Options) -> dict[str, Any]:
    """Everything but the list of files; no dates and no machine names."""
    form = core.dynamics.formulation
    chosen = asdict(options)
    prefix = chosen.pop("prefix")
    return {
        "prefix": prefix,
        "model_hash": core.tape.fingerprint,
        "network": core.dynamics.name,
        "formulation": None
        if form is None
        else {
            "name": form.name,
            "fingerprint": form.fingerprint,
            "citation": form.citation,
        },
        "options": chosen,
        "operations_per_step": core.tape.n_values,
        "state": _row(core.state),
        "inputs": [_row(field) for field in core.inputs],
        "output": _row(core.output),
        "versions": {name: metadata.version(name) for name in ("rrnn_opt", "casadi")},
    }


def _row(field: Field) -> dict[str, Any]:
    return {
        "name": field.name,
        "shape": list(field.shape),
        "unit": field.unit,
        "meaning": field.meaning,
    }
