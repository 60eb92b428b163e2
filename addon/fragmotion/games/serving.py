# SPDX-License-Identifier: GPL-3.0-or-later
"""The live page with a character, to browsers on this machine alone."""

from __future__ import annotations

from functools import partial
from http import HTTPStatus
from http.server import SimpleHTTPRequestHandler, ThreadingHTTPServer
from pathlib import Path
from threading import Thread

_HERE = "127.0.0.1"


class _Handler(SimpleHTTPRequestHandler):
    """A folder's files, and a few that are nowhere but in memory."""

    # Some systems name others, with which browsers take no modules.
    extensions_map = {  # noqa: RUF012 (as the base class has it)
        **SimpleHTTPRequestHandler.extensions_map,
        ".js": "text/javascript",
        ".mjs": "text/javascript",
        ".wasm": "application/wasm",
    }

    def __init__(self, own: dict[str, bytes], *arguments: object, **options: object) -> None:
        self.own = own
        super().__init__(*arguments, **options)  # type: ignore[arg-type]

    def do_GET(self) -> None:
        if self.headers.get("Host", "").partition(":")[0] != _HERE:  # another site's page, by a name that leads here
            self.send_error(HTTPStatus.FORBIDDEN)
            return
        data = self.own.get(self.path.partition("?")[0].lstrip("/"))
        if data is None:
            super().do_GET()
            return
        self.send_response(HTTPStatus.OK)
        self.send_header("Content-Length", str(len(data)))
        self.send_header("Cache-Control", "no-store")
        self.end_headers()
        self.wfile.write(data)

    def log_message(self, format: str, *arguments: object) -> None:
        """Nobody reads it."""


_server: ThreadingHTTPServer | None = None


def start(page: Path, own: dict[str, bytes]) -> str:
    """Serve a page's folder, with files of one's own beside it, instead of what was served before; the address."""
    global _server
    stop()
    _server = ThreadingHTTPServer((_HERE, 0), partial(_Handler, own, directory=str(page)))
    Thread(target=_server.serve_forever, daemon=True).start()
    return f"http://{_HERE}:{_server.server_address[1]}/"


def stop() -> None:
    """Serve nothing any more."""
    global _server
    if _server is not None:
        _server.shutdown()
        _server.server_close()
        _server = None
