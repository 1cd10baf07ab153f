"""The command line ``rrnn``: one file a command; only this room prints."""
