"""Pictures, pages and tables of plain results.

Everything here reads documents (the JSON of a result) and draws them; nothing
is computed that a verdict could rest on.
"""

from rrnn_opt.report.claims import claims_html, claims_markdown, claims_table
from rrnn_opt.report.files import file_name, write_bytes, write_text
from rrnn_opt.report.plan.files import write_plan
from rrnn_opt.report.plan.page import write_page
from rrnn_opt.report.plan.picture import draw_plan
from rrnn_opt.report.region_map import draw_region
from rrnn_opt.report.tables import check_line, table
from rrnn_opt.report.tracking import draw_tracking

__all__ = [
    "check_line",
    "claims_html",
    "claims_markdown",
    "claims_table",
    "draw_plan",
    "draw_region",
    "draw_tracking",
    "file_name",
    "table",
    "write_bytes",
    "write_page",
    "write_plan",
    "write_text",
]
