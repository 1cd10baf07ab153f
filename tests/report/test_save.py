"""Names in letters that the font lacks are drawn without a warning."""

import io
import warnings

from matplotlib.figure import Figure

from rrnn_opt.report.save import save


def test_letters_without_a_glyph_are_drawn_as_boxes():
    figure = Figure()
    figure.text(0.5, 0.5, "机械臂 \U0001f600 ü")
    raw = io.BytesIO()
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        save(figure, raw, format="png")
    assert raw.getvalue().startswith(b"\x89PNG")
