"""One SMT solver on one claim, as a process of its own.

Run by path, with nothing of this package imported.  Standard input is JSON
``{"solver", "common", "negations", "variables", "timeout_s"}``, standard output
``{"status": "unsat" | "sat" | "unknown", "model": {name: "p/q"}}``.
"""

import importlib
import json
import sys
from fractions import Fraction
from typing import Any

Answer = tuple[str, dict[str, str]]


def ask_z3(
    common: str, negation: str, variables: list[str], timeout_s: float
) -> Answer:
    """Status and model of one query."""
    z3: Any = importlib.import_module("z3")
    solver = z3.Solver()
    solver.set("timeout", max(1, int(1000 * timeout_s)))
    solver.from_string(f"{common}\n(assert {negation})")
    status = str(solver.check())
    if status != "sat":
        return status, {}
    found = solver.model()
    numbers = {name: found.eval(z3.Real(name), True) for name in variables}
    return status, {name: str(_rational(x)) for name, x in numbers.items()}


def _rational(number: Any) -> Fraction:
    if hasattr(number, "approx"):  # an algebraic number: to 30 digits
        number = number.approx(30)
    return Fraction(number.numerator_as_long(), number.denominator_as_long())


def ask_cvc5(
    common: str, negation: str, variables: list[str], timeout_s: float
) -> Answer:
    """Status of one query; no model is read."""
    cvc5: Any = importlib.import_module("cvc5")
    solver = cvc5.Solver()
    solver.setOption("tlimit-per", str(max(1, int(1000 * timeout_s))))
    parser = cvc5.InputParser(solver)
    text = f"(set-logic ALL)\n{common}\n(assert {negation})\n"
    parser.setStringInput(cvc5.InputLanguage.SMT_LIB_2_6, text, "claim")
    symbols = parser.getSymbolManager()
    while not (command := parser.nextCommand()).isNull():
        command.invoke(solver, symbols)
    result = solver.checkSat()
    status = "unsat" if result.isUnsat() else "sat" if result.isSat() else "unknown"
    return status, {}


def main() -> None:
    """Answer the question on standard input."""
    job = json.load(sys.stdin)
    ask = {"z3": ask_z3, "cvc5": ask_cvc5}[job["solver"]]
    answer: Answer = ("unsat", {})
    for negation in job["negations"]:
        status, model = ask(job["common"], negation, job["variables"], job["timeout_s"])
        if status != "unsat":
            answer = (status, model)
            break
    json.dump({"status": answer[0], "model": answer[1]}, sys.stdout)


if __name__ == "__main__":
    main()
