"""Guaranteed bounds of expressions over boxes of their variables (SUP and INF)."""

from __future__ import annotations

import json
import math
from collections.abc import Iterable, Mapping
from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt
import pandas as pd

from . import _assay
from .errors import WrongUsage

End = float | str | npt.ArrayLike
Number = npt.NDArray[np.float64]


class Bounds(NamedTuple):
    """Guaranteed bounds, rounded outward.

    Each member has the shape of the variables' ends. If several expressions were given, it has one
    more axis at its end. For one box and one expression, each member is a number.

    inf, sup: no value of the expression is below inf or above sup. If no point satisfies the
        constraints, inf is infinite and sup is minus infinite.
    gap: an upper limit of the distance between a bound and the true least or greatest value.
    evaluations: the number of evaluations for both bounds together.
    method: the bounding method that gave the looser bound.
    """

    inf: Any
    sup: Any
    gap: Any
    evaluations: Any
    method: Any


class Expressions:
    """Expressions that are parsed once and bounded over many boxes.

    expressions: texts such as "3*cos(t) + x", with + - * / ^, sin, cos, sqrt, abs, min and max.
    variables: the ends (low, high) of each variable: numbers, arrays that broadcast to one shape,
        or texts "N deg", "inf" and "-inf".
    constraints: texts such as "x <= y + 1".

    Raises WrongInput for a text that is no expression, and WrongUsage for ends that are no pair.
    """

    def __init__(self, expressions: str | Iterable[str], variables: Mapping[str, tuple[End, End]],
                 constraints: Iterable[str] = ()) -> None:
        self._is_single = isinstance(expressions, str)
        texts = [expressions] if isinstance(expressions, str) else list(expressions)
        ends = {name: _pair(name, pair) for name, pair in variables.items()}
        self._arrays = {name: pair for name, pair in ends.items() if not isinstance(pair[0], str)}
        declared = {name: [_text(pair[0], np.min), _text(pair[1], np.max)]
                    for name, pair in ends.items()}
        self._compiled = _assay.Expressions(json.dumps(
            {"variables": declared, "constraints": list(constraints), "expressions": texts}),
            "<expressions>")
        self.variables: list[str] = self._compiled.variables

    def bound(self, *, method: str = "refined", gap: float = 1e-6,
              evaluations: int = 200_000) -> Bounds:
        """Bounds the expressions over each box.

        method: "refined" refines the bounds until the gap is reached; "termwise" bounds each term
            alone, as in the paper.
        gap: the wanted gap between a bound and the true least or greatest value.
        evaluations: the limit of evaluations for each bound. Bounds are guaranteed even if the
            limit is reached.
        """
        if method not in ("refined", "termwise"):
            raise WrongUsage(f"there is no method {method!r}; allowed: refined, termwise")
        if not gap >= 0 or evaluations < 1:
            raise WrongUsage("allowed: a gap of 0 or more, and 1 evaluation or more")
        boxes, shape = self._boxes()
        found = self._compiled.bounds(boxes, method, gap, evaluations)
        if not self._is_single:
            shape = (*shape, len(self._compiled.texts))
        inf, sup = found["inf"].reshape(shape), found["sup"].reshape(shape)
        is_vacuous = (sup == -np.inf) | (inf == np.inf)
        return Bounds(_scalar(np.where(is_vacuous, np.inf, inf)),
                      _scalar(np.where(is_vacuous, -np.inf, sup)),
                      _scalar(found["gap"].reshape(shape)),
                      _scalar(found["evaluations"].reshape(shape)),
                      _scalar(np.array(found["method"], dtype=object).reshape(shape)))

    def sensitivity(self) -> pd.DataFrame:
        """What each variable's uncertainty costs over the hull of all boxes.

        Columns: expression, bound ("inf" or "sup"), variable, cost (by how much the bound would
        improve if the variable were at its midpoint). Variables without a cost are left out.
        """
        return pd.DataFrame(self._compiled.shares(),
                            columns=["expression", "bound", "variable", "cost"])

    def _boxes(self) -> tuple[Number, tuple[int, ...]]:
        """Returns an array of shape (boxes, variables, 2), and the shape of the ends."""
        ends: list[npt.ArrayLike] = []
        for name, declared in zip(self.variables, self._compiled.box):
            ends += self._arrays.get(name, declared)
        try:
            arrays = np.broadcast_arrays(*(np.asarray(end, dtype=float) for end in ends))
        except ValueError as error:
            raise WrongUsage(f"the ends of the variables have shapes that do not agree: {error}")
        shape = arrays[0].shape if arrays else ()
        count = math.prod(shape)
        stacked = np.stack([array.reshape(count) for array in arrays], axis=-1)
        boxes = stacked.reshape(count, len(self.variables), 2)
        if not (boxes[..., 0] <= boxes[..., 1]).all():
            raise WrongUsage("the lower end of a variable is greater than its upper end, or no "
                             "number")
        return boxes, shape


def bound(expressions: str | Iterable[str], variables: Mapping[str, tuple[End, End]],
          constraints: Iterable[str] = (), *, method: str = "refined", gap: float = 1e-6,
          evaluations: int = 200_000) -> Bounds:
    """Bounds expressions over intervals and inequalities.

        assay.bound("3*cos(t) + x", {"t": (-0.1, 0.1), "x": (0, 1)})

    The arguments are those of Expressions and of Expressions.bound.
    """
    return Expressions(expressions, variables, constraints).bound(
        method=method, gap=gap, evaluations=evaluations)


def sensitivity(expressions: str | Iterable[str], variables: Mapping[str, tuple[End, End]],
                constraints: Iterable[str] = ()) -> pd.DataFrame:
    """Returns what each variable's uncertainty costs (Expressions.sensitivity)."""
    return Expressions(expressions, variables, constraints).sensitivity()


def _pair(name: str, ends: Any) -> tuple[Any, Any]:
    try:
        low, high = ends
    except (TypeError, ValueError):
        raise WrongUsage(f"the variable {name!r} has no two ends; allowed: (low, high)") from None
    if isinstance(low, str) or isinstance(high, str):
        return (_text(low, np.min), _text(high, np.max))
    return np.asarray(low, dtype=float), np.asarray(high, dtype=float)


def _text(end: Any, extreme: Any) -> str:
    if isinstance(end, str):
        return end
    array = np.asarray(end, dtype=float)
    return repr(float(extreme(array))) if array.size else "0"


def _scalar(array: npt.NDArray[Any]) -> Any:
    return array.item() if array.ndim == 0 else array
