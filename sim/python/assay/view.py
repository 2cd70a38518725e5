"""Pages that show an execution in three dimensions."""

from __future__ import annotations

import html as _html
import os
from pathlib import Path


class View:
    """A page that shows an execution in three dimensions, with its certificates.

    The page is one HTML file that fetches nothing. In a notebook it is shown in the cell.
    """

    def __init__(self, html: str, height: int = 600) -> None:
        self.html = html
        self.height = height  # pixels, in a notebook

    def save(self, path: str | os.PathLike[str]) -> Path:
        """Writes the page, and returns its path. Raises OSError if that is not possible."""
        file = Path(path)
        file.write_text(self.html, encoding="utf-8")
        return file

    def _repr_html_(self) -> str:
        return (f'<iframe srcdoc="{_html.escape(self.html)}" width="100%" height="{self.height}" '
                'style="border: 0"></iframe>')

    def __repr__(self) -> str:
        return f"<View: a page of {len(self.html) / 1000:.0f} kB>"
