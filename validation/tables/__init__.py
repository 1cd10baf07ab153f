"""The paper's tables, run again, with its numbers beside ours."""
