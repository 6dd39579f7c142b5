"""Results say when they were made: in these tests always at the same time."""

import os

os.environ["SOURCE_DATE_EPOCH"] = "1773480413"
