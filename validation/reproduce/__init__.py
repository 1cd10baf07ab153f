"""The whole paper run again: one report with its numbers beside ours."""
