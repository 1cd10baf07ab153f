"""All entries, in the order of the table."""

from __future__ import annotations

from benchmarks.fuzz import arguments, commands, documents, files, kept, objects

ENTRIES = (
    *files.ENTRIES,
    *documents.ENTRIES,
    *kept.ENTRIES,
    *arguments.ENTRIES,
    *objects.ENTRIES,
    *commands.ENTRIES,
)
"""Everything that takes input."""
