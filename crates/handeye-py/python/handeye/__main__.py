"""``python -m handeye``: the program."""

from ._commands import main

main()
