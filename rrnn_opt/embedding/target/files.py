"""Files that a package holds for the machine it is built for."""

from __future__ import annotations

from rrnn_opt.embedding.options import Options


def target_files(options: Options, words: dict[str, str]) -> dict[str, str]:
    """Text by path; the words are those of ``render.common_words``.

    Args:
        options: the target among them.
        words: for the templates.
    """
    del options, words
    return {}
