"""Generated controllers under any requests, their monitor on."""
