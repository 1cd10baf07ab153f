"""Engine "smt": z3 and cvc5 on the negation of a claim."""
