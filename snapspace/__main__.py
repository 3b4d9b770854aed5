"""`python -m snapspace` is `snapspace`."""

from .cli import main

raise SystemExit(main())
