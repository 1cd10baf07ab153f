"""A package as text, with the manifest that lists its files."""

from __future__ import annotations

import hashlib
import json
import os
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from rrnn_opt.arguments import checked
from rrnn_opt.embedding.placing import KIND, MANIFEST, inside, place
from rrnn_opt.embedding.words import require_prefix
from rrnn_opt.errors import RrnnError


@checked()
@dataclass(frozen=True)
class Package:
    """Files of a controller.

    Attributes:
        prefix: of every exported name; also the folder's name.
        files: text by relative path, MANIFEST.json among them.

    Raises:
        RrnnError: the prefix is no C name, or a path leads out of the folder.
    """

    prefix: str
    files: Mapping[str, str]

    def __post_init__(self) -> None:
        require_prefix(self.prefix)
        for path in self.files:
            if not inside(path):
                raise RrnnError(f"{path[:80]!a} is no name of a file of a package")

    @property
    def manifest(self) -> dict[str, Any]:
        """MANIFEST.json."""
        document: dict[str, Any] = json.loads(self.files[MANIFEST])
        return document

    def write(self, out_dir: str | os.PathLike[str]) -> Path:
        """Write ``out_dir/<prefix>/``.

        A new folder appears at once and whole.  Over a package written before, its
        files are removed and the new ones moved in, headers and manifest last:
        files of two packages never stand side by side, and while there is no
        manifest no compiler finds the headers.  Files of others in there are
        left alone.

        Args:
            out_dir: folder to write into; made when there is none.

        Returns:
            The folder of the package.

        Raises:
            RrnnError: there is something of that name that is not our package,
                or the folder cannot be written.
        """
        target = Path(out_dir) / self.prefix
        try:
            place(self.files, target)
        except OSError as error:
            raise RrnnError(f"cannot write '{target}': {error}") from error
        return target


def with_manifest(
    prefix: str, files: Mapping[str, str], facts: Mapping[str, Any]
) -> Package:
    """A package of ``files`` and the manifest that lists them.

    Args:
        prefix: of every exported name.
        files: text by relative path.
        facts: what else the manifest says; no dates and no machine names.
    """
    hashes = {path: _hash(text) for path, text in sorted(files.items())}
    manifest = {"kind": KIND, "schema": 1, **facts, "files": hashes}
    text = json.dumps(manifest, indent=2, allow_nan=False) + "\n"
    return Package(prefix, {**files, MANIFEST: text})


def _hash(text: str) -> str:
    return hashlib.sha256(text.encode()).hexdigest()
