"""An SMT solver in a process of its own; run by path, imports nothing of ours.

Standard input: JSON ``{"solver", "lines", "broken"}``.  Standard output: the
solver's word on every formula of ``broken``, one a line, up to the first that is
not "unsat".
"""

import importlib
import json
import sys
from typing import Any


def z3_says(text: str) -> str:
    """Satisfiability by z3."""
    z3: Any = importlib.import_module("z3")
    solver = z3.Solver()
    solver.add(*z3.parse_smt2_string(text))
    return str(solver.check())


def cvc5_says(text: str) -> str:
    """Satisfiability by cvc5."""
    cvc5: Any = importlib.import_module("cvc5")
    solver = cvc5.Solver()
    parser = cvc5.InputParser(solver)
    parser.setStringInput(
        cvc5.InputLanguage.SMT_LIB_2_6, "(set-logic ALL)\n" + text, "claim"
    )
    symbols = parser.getSymbolManager()
    command = parser.nextCommand()
    while not command.isNull():
        command.invoke(solver, symbols)
        command = parser.nextCommand()
    result = solver.checkSat()
    return "unsat" if result.isUnsat() else "sat" if result.isSat() else "unknown"


def main() -> None:
    """Answer one job."""
    job = json.load(sys.stdin)
    says = {"z3": z3_says, "cvc5": cvc5_says}[job["solver"]]
    for formula in job["broken"]:
        word = says("\n".join([*job["lines"], f"(assert {formula})"]))
        sys.stdout.write(word + "\n")
        if word != "unsat":
            break


if __name__ == "__main__":
    try:
        main()
    except ImportError as error:
        sys.exit(f"not installed: {error.name} (pip install rrnn_opt[verify])")
