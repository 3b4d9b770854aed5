"""Writes the addresses of the project into pyproject.toml: `python tools/project_urls.py HOME`.

The workflow that builds wheels knows where the repository is, so that a wheel's addresses are
those of the repository that built it, whoever hosts it. HOME is the address of the repository,
such as `$GITHUB_SERVER_URL/$GITHUB_REPOSITORY`.
"""

from __future__ import annotations

import argparse
import re
import sys
from pathlib import Path
from urllib.parse import urlsplit

PROJECT = Path(__file__).parents[1] / "pyproject.toml"


def with_urls(text: str, home: str) -> str:
    """A pyproject.toml whose `[project.urls]` are those of a repository, in place of any others.

    Raises ValueError if `home` is not an https address of a host and a path.
    """
    parts = urlsplit(home)
    if parts.scheme != "https" or not parts.netloc or not parts.path.strip("/"):
        raise ValueError(f"project_urls: needs https://HOST/OWNER/NAME; got {home!r}")
    if re.search(r'[\s"\\]', home) or parts.query or parts.fragment:
        raise ValueError(f"project_urls: {home!r} is not the address of a repository")
    home = home.rstrip("/").removesuffix(".git")
    urls = {
        "Homepage": home,
        "Source": home,
        "Documentation": f"{home}/tree/main/docs",
        "Issues": f"{home}/issues",
        "Changelog": f"{home}/blob/main/CHANGELOG.md",
    }
    section = "[project.urls]\n" + "".join(f'{name} = "{url}"\n' for name, url in urls.items())
    text = re.sub(r"^\[project\.urls\]\n(?:[^\[\n].*\n)*\n?", "", text, flags=re.M)
    return text.replace("[project.scripts]", f"{section}\n[project.scripts]", 1)


def main() -> int:
    parser = argparse.ArgumentParser(prog="project_urls", description=__doc__)
    parser.add_argument("home", metavar="HOME", help="https address of the repository")
    home = parser.parse_args().home
    try:
        text = with_urls(PROJECT.read_text("utf-8"), home)
    except ValueError as error:
        print(error, file=sys.stderr)
        return 2
    temporary = PROJECT.with_suffix(".toml.part")
    temporary.write_text(text, "utf-8")
    temporary.replace(PROJECT)
    return 0


if __name__ == "__main__":
    sys.exit(main())
