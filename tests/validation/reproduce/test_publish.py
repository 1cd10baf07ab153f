"""The page of the documentation says what the report said."""

import io

import pytest

from rrnn_opt.study import Row, environment
from rrnn_opt.validation.reproduce.publish import WIDTH, main, published
from rrnn_opt.validation.reproduce.report import write_report
from rrnn_opt.validation.reproduce.run import part_of

Image = pytest.importorskip("PIL.Image", reason="Pillow is not installed")


def lines_with(text, word):
    return [line for line in text.splitlines() if word in line]


def test_numbers_stay_and_links_hold(tmp_path, capsys):
    run, docs = tmp_path / "run", tmp_path / "docs"
    for folder in (run, docs / "images", docs / "results"):
        folder.mkdir(parents=True)
    rows = [Row(str(k), {"start": k, "solved": k < 19}) for k in range(20)]
    part = part_of("raven", rows, trials=20)
    Image.effect_noise((2 * WIDTH, 40), 50).save(run / "raven.png")
    write_report(
        run,
        [part],
        drawn={"raven": run / "raven.png"},
        environment=environment(),
        damaged=0,
    )
    assert main([str(run), "--docs", str(docs), "--note", "Said beside it."]) == 0
    page, picture = (docs / "results/reproduction.md", "reproduction_raven.png")
    assert str(page) in capsys.readouterr().out
    text, report = page.read_text(), (run / "reproduce.md").read_text()
    assert lines_with(text, "| 0.95 |") == lines_with(report, "| 0.95 |") != []
    assert part.digest in text
    assert "Said beside it." in text
    assert f"(../images/{picture})" in text
    assert "](raven" not in text
    image = Image.open(io.BytesIO((docs / "images" / picture).read_bytes()))
    assert image.size == (WIDTH, 20)
    assert image.mode == "P"


def test_without_links_nothing_changes():
    assert published("# Title\n\n| a | b |\n") == "# Title\n\n| a | b |\n"
