"""What the checks of the site share: `tox run -e docs` runs them after the build."""

import sys
from pathlib import Path

DOCS = Path(__file__).parents[1]
sys.path.insert(0, str(DOCS / "extensions"))
