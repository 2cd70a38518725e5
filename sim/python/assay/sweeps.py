"""Grids of trials in a database."""

from __future__ import annotations

import os
import sqlite3
from collections.abc import Iterable, Sequence
from contextlib import closing
from pathlib import Path
from typing import Any

import pandas as pd

from . import _assay
from .errors import Interrupted, WrongUsage
from .trials import require_jobs

_TABLES = ("attack", "attack_worst", "cell", "claim", "conservatism", "counterexample", "gate",
           "gate_component", "observation", "planning", "run", "sweep", "timing", "trial",
           "verdict")


class SweepDatabase:
    """The results of a sweep. sim/sweep/database/schema.cc defines the columns of all tables.

    Raises WrongInput if the file is no database of a sweep, or a damaged one.
    """

    def __init__(self, path: str | os.PathLike[str]) -> None:
        self.path = Path(path)
        _assay.require_database(os.fspath(path))

    @property
    def trials(self) -> pd.DataFrame:
        """One row for each trial, with the settings of its cell."""
        return self.query(
            "SELECT trial.*, cell.scenario, cell.clearance, cell.error_scale, cell.propagation, "
            "cell.resolvers, cell.noise AS noise_kind, cell.sensing, cell.seed, cell.grasp "
            "FROM trial JOIN cell USING (cell) ORDER BY trial.trial")

    @property
    def cells(self) -> pd.DataFrame:
        """One row for each cell of the grid, without the text of its plan."""
        return self.table("cell").drop(columns="plan")

    @property
    def verdicts(self) -> pd.DataFrame:
        """One row for each trial and step: the verdict on its certificate, and the worst claim."""
        return self.table("verdict")

    @property
    def counterexamples(self) -> pd.DataFrame:
        """One row for each counterexample that the falsifications found."""
        return self.table("counterexample")

    def table(self, name: str) -> pd.DataFrame:
        """Returns a whole table of the database. Raises WrongUsage if there is none."""
        if name not in _TABLES:
            raise WrongUsage(f"there is no table {name!r}; allowed: {', '.join(_TABLES)}")
        return self.query(f"SELECT * FROM {name}")

    def query(self, sql: str, parameters: Sequence[Any] = ()) -> pd.DataFrame:
        """Returns the rows that an SQL query reads. The query cannot change the database."""
        uri = f"{self.path.absolute().as_uri()}?mode=ro"
        with closing(sqlite3.connect(uri, uri=True)) as connection:
            return pd.read_sql_query(sql, connection, params=list(parameters))

    def __repr__(self) -> str:
        done = len(self.query("SELECT trial FROM trial"))
        return f"<SweepDatabase {self.path}: {done} trials>"


def sweep(file: str | os.PathLike[str], database: str | os.PathLike[str], *, jobs: int = 1,
          resume: bool = False, models: Iterable[str | os.PathLike[str]] = ()) -> SweepDatabase:
    """Runs the trials of a sweep file into a database, and returns the database.

    jobs: the number of threads. The results do not depend on it.
    resume: whether only the trials are run that are not in the database yet. If it is false, the
        database must not exist.
    models: more folders of models.

    Raises WrongInput for a wrong file or a database of another sweep, WrongUsage for wrong
    arguments, and Interrupted at Ctrl-C. The attribute `result` of Interrupted is the database with
    all trials that were finished.
    """
    require_jobs(jobs)
    if os.fspath(database) == ":memory:":
        raise WrongUsage("sweep: ':memory:' would be lost at the end; allowed: a file")
    end = _assay.run_sweep(os.fspath(file), os.fspath(database), [os.fspath(m) for m in models],
                           jobs, resume)
    made = SweepDatabase(database)
    if end["is_interrupted"]:
        raise Interrupted(f"{end['before'] + end['done']} trials are done", made)
    return made
