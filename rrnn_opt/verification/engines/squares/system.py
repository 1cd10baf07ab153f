"""The linear equations behind an identity of squares, exactly and in floats."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import Any

import numpy as np
from flint import fmpq, fmpq_mat
from numpy.typing import NDArray
from scipy.linalg import qr

from rrnn_opt.check.claims.graph.expansion import Polynomial
from rrnn_opt.errors import UndecidedError
from rrnn_opt.verification.engines.conic import ConicProgram
from rrnn_opt.verification.engines.squares.relaxation import Relaxation, sparse, written

Array = NDArray[np.float64]
MAX_TABLE = 8_000_000
"""Coefficients of the equations, zeros included."""


@dataclass(frozen=True)
class Block:
    """A product of inequalities times a sum of squares.

    Attributes:
        factors: numbers of the inequalities.
        product: their product.
        basis: what is squared.
    """

    factors: tuple[int, ...]
    product: Polynomial
    basis: tuple[Polynomial, ...]


class System:
    """The equations between Gram entries, multipliers and the target.

    Raises:
        UndecidedError: there are too many equations.
    """

    def __init__(self, parts: Relaxation, blocks: Sequence[Block]) -> None:
        self.parts, self.blocks = parts, blocks
        self.width = sum(len(b.basis) for b in blocks)
        columns: list[Polynomial] = []
        for block in blocks:
            for j, right in enumerate(block.basis):
                for i, left in enumerate(block.basis[: j + 1]):
                    twice = 1 if i == j else 2
                    pair = parts.reduced(left * right * twice)
                    columns.append(parts.reduced(pair * block.product))
        self.entries = len(columns)
        if parts.strict:
            columns.append(parts.setting.forms.ring.constant(1))
        equalities = parts.setting.equalities
        columns += [parts.reduced(m * equalities[k]) for k, m in parts.multipliers]
        self.columns = [sparse(c) for c in columns]
        self.target = sparse(parts.target)
        keys = [m for column in (*self.columns, self.target) for m in column]
        self.number = {m: k for k, m in enumerate(dict.fromkeys(keys))}
        if len(self.number) * len(columns) > MAX_TABLE:
            raise UndecidedError(f"{len(self.number)} equations are too many")
        self.scale = max((abs(_float(x)) for x in self.target.values()), default=1.0)

    def matrix(self) -> Array:
        """Coefficients of the columns, (monomials, columns)."""
        table = np.zeros((len(self.number), len(self.columns)))
        for k, column in enumerate(self.columns):
            for monomial, x in column.items():
                table[self.number[monomial], k] = _float(x)
        return table

    def program(self) -> ConicProgram:
        """Largest least eigenvalue such that the sum is the target."""
        right = np.zeros(len(self.number))
        for monomial, x in self.target.items():
            right[self.number[monomial]] = _float(x) / self.scale
        return ConicProgram(
            self.matrix(),
            right,
            tuple(len(b.basis) for b in self.blocks),
            1 if self.parts.strict else 0,
        )

    def grams(self, values: Array) -> list[Array]:
        """The Gram matrix of every block."""
        matrices, start = [], 0
        for block in self.blocks:
            size = len(block.basis)
            matrix = np.zeros((size, size))
            upper = np.triu_indices(size)
            order = np.lexsort((upper[0], upper[1]))
            count = size * (size + 1) // 2
            matrix[upper[0][order], upper[1][order]] = values[start : start + count]
            matrices.append(matrix + np.triu(matrix, 1).T)
            start += count
        return matrices

    def rounded(self, values: Array, bits: int) -> list[fmpq] | None:
        """Rational values that satisfy the equations exactly, near the given ones."""
        exact = [_dyadic(x * self.scale, bits) for x in values]
        rest = dict(self.target)
        zero = fmpq(0)
        for x, column in zip(exact, self.columns, strict=True):
            if x != 0:
                for monomial, y in column.items():
                    rest[monomial] = rest.get(monomial, zero) - x * y
        table = self.matrix()
        _, upper, order = qr(table, mode="economic", pivoting=True)
        size = np.abs(np.diag(upper))
        rank = int(np.sum(size > 1e-9 * size.max(initial=1e-300)))
        chosen = [int(k) for k in order[:rank]]
        system = fmpq_mat(
            [
                [self.columns[k].get(m, zero) for k in chosen] + [rest.get(m, zero)]
                for m in self.number
            ]
        )
        solved, solved_rank = system.rref()
        if solved_rank != rank:
            return None
        for row, k in enumerate(chosen):
            exact[k] += solved[row, rank]
        return exact if self._good(exact) else None

    def _good(self, exact: Sequence[fmpq]) -> bool:
        margin = not self.parts.strict or exact[self.entries] > 0
        values = np.array([_float(x) for x in exact])
        return margin and all(
            np.linalg.eigvalsh(g)[0] > 0 for g in self.grams(values) if g.size
        )

    def written(self, exact: Sequence[fmpq]) -> dict[str, Any]:
        """The proof of one element, as the payload writes it."""
        numbers = iter(exact)
        squares = []
        for block in self.blocks:
            size = len(block.basis)
            gram = [["0"] * size for _ in range(size)]
            for j in range(size):
                for i in range(j + 1):
                    gram[i][j] = gram[j][i] = str(next(numbers))
            basis = [written(b) for b in block.basis]
            part = {"factors": list(block.factors), "basis": basis, "gram": gram}
            squares.append(part)
        margin = str(next(numbers)) if self.parts.strict else "0"
        multipliers = [
            {"equality": k, "polynomial": written(m * x)}
            for (k, m), x in zip(self.parts.multipliers, numbers, strict=True)
            if x != 0
        ]
        return {"margin": margin, "squares": squares, "multipliers": multipliers}


def _dyadic(x: float, bits: int) -> fmpq:
    return fmpq(round(Fraction(float(x)) * 2**bits), 2**bits)


def _float(x: fmpq) -> float:
    return float(Fraction(int(x.p), int(x.q)))
