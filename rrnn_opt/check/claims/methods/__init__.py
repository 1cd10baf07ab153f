"""One method of judging a file; each answers, and only the certificate seals."""
