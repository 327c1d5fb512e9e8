"""The server of the page: who may ask, and what is answered.

It listens on the loopback interface only, which other users of the machine reach too: who has no cookie gets nothing.
The cookie is given for a token that is printed, and passed to the browser in a file of the user's own.
"""

from __future__ import annotations

import asyncio
import contextlib
import hmac
import json
import logging
import os
import secrets
import signal
import socket
import sys
import tempfile
import threading
import webbrowser
from collections.abc import Awaitable, Callable, Iterator, Mapping
from importlib import resources
from pathlib import Path
from types import FrameType
from typing import Any, NoReturn

import uvicorn
from anyio import to_thread
from starlette.applications import Starlette
from starlette.concurrency import run_in_threadpool
from starlette.requests import Request
from starlette.responses import JSONResponse, PlainTextResponse, RedirectResponse, Response
from starlette.routing import Route
from starlette.types import ASGIApp, Message, Receive, Scope, Send

from dondolo._base.arguments import argument_error, as_count
from dondolo._base.files import read_text
from dondolo._fortran.library import constants, properties
from dondolo.analysis.request import check_threads
from dondolo.errors import DondoloError, InputError, Interrupted
from dondolo.serve.bench import Bench, groups_of, known_language, other_task, refusal
from dondolo.serve.documents import DOCUMENTS, available_documents, make_document

# What answers may take at the end of the server [s]
_GRACE = 1
# What ends it: Ctrl-C, what systems and shells send, and the end of the terminal
_SIGNALS = [name for name in ("SIGINT", "SIGTERM", "SIGHUP", "SIGBREAK") if hasattr(signal, name)]
# Largest request [bytes]
_LARGEST = 200_000
# Files of the page and their types
_FILES = {
    "page.html": "text/html",
    "page.css": "text/css",
    "page.js": "text/javascript",
    "state.js": "text/javascript",
    "form.js": "text/javascript",
    "refusals.js": "text/javascript",
    "chart.js": "text/javascript",
    "wall.js": "text/javascript",
    "words.js": "text/javascript",
    "icon.svg": "image/svg+xml",
}
_HEADERS = {
    "content-security-policy": "default-src 'none'; script-src 'self'; style-src 'self'; img-src 'self' data:; "
    "connect-src 'self'; form-action 'none'; frame-ancestors 'none'; base-uri 'none'",
    "x-content-type-options": "nosniff",
    "referrer-policy": "no-referrer",
    "cross-origin-opener-policy": "same-origin",
    "cross-origin-resource-policy": "same-origin",
    "cache-control": "no-store",
}


# What answers a question, until an event is set
_Work = Callable[[Mapping[str, Any], threading.Event], Response]


class Works:
    """What is being answered: all of it ends when the server does."""

    def __init__(self) -> None:
        self._stops: set[threading.Event] = set()
        self._has_ended = False

    @contextlib.contextmanager
    def begun(self) -> Iterator[threading.Event]:
        """An event that is set once the work is to end; its own end is that of the block."""
        stop = threading.Event()
        self._stops.add(stop)
        if self._has_ended:
            stop.set()
        try:
            yield stop
        finally:
            stop.set()
            self._stops.discard(stop)

    def end(self) -> None:
        """Let all of it end, and what begins later; a handler of signals may call it at any instant."""
        self._has_ended = True
        for stop in tuple(self._stops):
            stop.set()


class Guard:
    """Lets through what the page itself asks: right host, right origin, the cookie, small JSON.

    Parameters
    ----------
    app : ASGI application
        What is guarded.
    port : int
        Where it listens.
    token : str
        What the first visit must show; the cookie afterwards.
    """

    def __init__(self, app: ASGIApp, port: int, token: str) -> None:
        self._app, self._token = app, token
        self._hosts = {f"{name}:{port}" for name in ("127.0.0.1", "localhost")}
        self._cookie = f"dondolo-{port}"

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        if scope["type"] == "lifespan":
            await self._app(scope, receive, send)
            return
        if scope["type"] != "http":
            return

        async def answer(message: Message) -> None:
            if message["type"] == "http.response.start":
                extra = [(name.encode(), value.encode()) for name, value in _HEADERS.items()]
                message = {**message, "headers": [*message["headers"], *extra]}
            await send(message)

        request = Request(scope)
        refused = self._refusal(request)
        if refused is not None:
            await refused(scope, receive, answer)
            return
        if request.method != "POST":
            await self._app(scope, receive, answer)
            return
        # What is sent may be longer than what its header says.
        body, more = b"", True
        while more and len(body) <= _LARGEST:
            part = await receive()
            if part["type"] != "http.request":
                return
            body, more = body + part.get("body", b""), part.get("more_body", False)
        if len(body) > _LARGEST:
            await PlainTextResponse("too large", 413)(scope, receive, answer)
            return

        is_known = False

        async def known() -> Message:
            nonlocal is_known
            if is_known:
                return await receive()
            is_known = True
            return {"type": "http.request", "body": body, "more_body": False}

        await self._app(scope, known, answer)

    def _refusal(self, request: Request) -> Response | None:
        """Why a request is not answered; None if it is."""
        origin = request.headers.get("origin")
        if request.headers.get("host") not in self._hosts or (
            origin is not None and origin.removeprefix("http://") not in self._hosts
        ):
            return PlainTextResponse("not from here", 403)
        if request.headers.get("sec-fetch-site") == "cross-site" and request.url.path != "/":
            return PlainTextResponse("not from here", 403)
        given = request.query_params.get("token")
        if given is not None and request.method == "GET" and request.url.path == "/":
            if not _same(given, self._token):
                return PlainTextResponse("wrong token: open the address that dondolo serve has printed", 403)
            # The token leaves the address bar and the history.
            response = RedirectResponse("/", 303)
            response.set_cookie(self._cookie, self._token, httponly=True, samesite="strict")
            return response
        if not _same(request.cookies.get(self._cookie, ""), self._token):
            return PlainTextResponse("no token: open the address that dondolo serve has printed", 403)
        if request.method not in ("GET", "POST"):
            return PlainTextResponse("no such method", 405)
        if request.method == "POST" and request.headers.get("content-type", "").split(";")[0] != "application/json":
            return PlainTextResponse("must be JSON", 415)
        return None


def _same(one: str, other: str) -> bool:
    return hmac.compare_digest(one.encode(), other.encode())


def application(
    bench: Bench, start: Mapping[str, Any], lang: str, port: int, token: str, works: Works | None = None
) -> ASGIApp:
    """The server's answers, guarded.

    Parameters
    ----------
    bench : Bench
        What computes.
    start : mapping
        Groups of the case that the page begins with.
    lang : str
        Its language.
    port : int
        Where it listens.
    token : str
        What the first visit must show.
    works : Works, optional
        Where its answers are known, so that they can be ended.

    Returns
    -------
    ASGI application
    """
    works = works or Works()
    page = resources.files("dondolo.serve") / "page"
    content = {name: (page / name).read_bytes() for name in _FILES}

    async def file(request: Request) -> Response:
        name = request.path_params.get("name", "page.html")
        if name not in content:
            return PlainTextResponse("no such page", 404)
        return Response(content[name], media_type=f"{_FILES[name]}; charset=utf-8")

    async def begin(request: Request) -> Response:
        return JSONResponse(await run_in_threadpool(_beginning, bench, start, lang))

    def answering(work: _Work) -> Callable[[Request], Awaitable[Response]]:
        async def answer(request: Request) -> Response:
            try:
                asked = json.loads(await request.body(), parse_constant=_no_number)
                if not isinstance(asked, dict):
                    raise ValueError("not an object")
            except (ValueError, RecursionError):
                return JSONResponse({"error": "the request must be a JSON object", "errors": []}, 422)
            with works.begun() as stop:
                left = asyncio.create_task(_set_when_left(request, stop))
                try:
                    # The server does not wait at its end for what takes no notice of the event.
                    return await to_thread.run_sync(_answered, work, asked, stop, abandon_on_cancel=True)
                except asyncio.CancelledError:
                    return PlainTextResponse("the server has ended", 503)
                finally:
                    left.cancel()

        return answer

    def opened(asked: Mapping[str, Any], _: threading.Event) -> Response:
        if not isinstance(asked.get("text"), str):
            raise argument_error("wrong_type", "text", ": must be that of a case")
        return JSONResponse({"settings": bench.open(asked["text"])})

    def document(asked: Mapping[str, Any], stop: threading.Event) -> Response:
        kind, lang = str(asked.get("kind")), asked.get("lang", "en")
        made = make_document(bench.text(groups_of(asked.get("settings")), lang), kind, lang, stop)
        return Response(made, media_type=DOCUMENTS[kind])

    routes = [
        Route("/", file),
        Route("/begin", begin),
        Route("/curve", answering(lambda asked, stop: JSONResponse(bench.curve(asked, stop))), methods=["POST"]),
        Route("/motion", answering(lambda asked, _: JSONResponse(bench.motion(asked))), methods=["POST"]),
        Route("/open", answering(opened), methods=["POST"]),
        Route("/document", answering(document), methods=["POST"]),
        Route("/{name}", file),
    ]
    return Guard(Starlette(routes=routes), port, token)


async def _set_when_left(request: Request, stop: threading.Event) -> None:
    """Set an event when nobody waits for the answer any more: the page has asked for a newer state, or was closed."""
    while (await request.receive())["type"] != "http.disconnect":
        pass
    stop.set()


def _answered(work: _Work, asked: Mapping[str, Any], stop: threading.Event) -> Response:
    """The answer to what is asked, or a refusal."""
    try:
        return work(asked, stop)
    except Interrupted:
        return PlainTextResponse("nobody waits for the answer", 503)
    except DondoloError as error:
        return JSONResponse(refusal(error), 422)


def _no_number(word: str) -> float:
    raise ValueError(f"{word}: JSON has no such number")


def _beginning(bench: Bench, start: Mapping[str, Any], lang: str) -> dict[str, Any]:
    """What the page needs once: its case, the tables of properties, the records, its words in other languages."""
    italian = known_language("it")
    meanings = italian.all_named("property of a case")
    tables = {
        group: {
            row.name: {
                "kind": row.kind,
                "unit": row.unit,
                "default": row.default,
                "low": row.smallest,
                "high": row.largest,
                "choices": row.choices,
                "owners": row.owners,
                "bounds": row.bounds,
                "meaning": {"en": row.meaning, "it": meanings[row.name]},
            }
            for row in properties(group)
        }
        for group in ("job", "wall", "building", "records", "stripes", "solver", "check")
    }
    return {
        "settings": start,
        "lang": lang,
        "words": {
            "it": {f"{what}s": italian.all_named(f"{what} of the page") for what in ("word", "label", "refusal")}
        },
        "properties": tables,
        "records": [record.name for record in bench.records],
        "catalogue": bench.catalogue.name,
        "synthetic": bench.are_synthetic,
        "documents": available_documents(),
        "version": constants().version,
    }


class _Server(uvicorn.Server):
    """A server that leaves signals to who runs it."""

    @contextlib.contextmanager
    def capture_signals(self) -> Iterator[None]:
        """Capture none."""
        yield


def serve(case: str | None, records: str | None, port: int, is_opened: bool, threads: int, lang: str) -> None:
    """Serve the page until Ctrl-C.

    Parameters
    ----------
    case : str or None
        Path of the case that the page begins with.
    records : str or None
        Path of a catalogue; that of the case, or the synthetic records, if left out.
    port : int
        Where to listen; 0: any that is free.
    is_opened : bool
        Whether to open the browser.
    threads : int
        Number of threads; 0: all.
    lang : {'en', 'it'}
        Language of the page.
    """
    as_count("--port", port, 0, 2**16 - 1)
    check_threads(threads)
    # Reading takes no notice of Ctrl-C before it is done; nothing is written, so that the process may end at once.
    heard = signal.signal(signal.SIGINT, signal.SIG_DFL)
    try:
        bench, start = beginning_of(case, records, threads)
    finally:
        signal.signal(signal.SIGINT, heard)
    # By its name, for asyncio sets TCP_NODELAY on such sockets alone: without it an answer ends 40 ms after it begins.
    with socket.socket(socket.AF_INET, socket.SOCK_STREAM, socket.IPPROTO_TCP) as listener:
        if os.name == "posix":
            listener.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        try:
            listener.bind(("127.0.0.1", port))
        except OSError as error:
            raise InputError(f"--port {port}: {error.strerror}") from None
        # A browser that is fast waits until the server answers, and is not refused.
        listener.listen()
        at, token = listener.getsockname()[1], secrets.token_urlsafe(32)
        address = f"http://127.0.0.1:{at}/?token={token}"
        works = Works()
        app = application(bench, start, lang, at, token, works)
        config = uvicorn.Config(
            app,
            log_level="warning",
            access_log=False,
            ws="none",
            lifespan="off",
            server_header=False,
            timeout_graceful_shutdown=_GRACE,
        )

        server = _Server(config)
        ended: list[int] = []

        def end(number: int, _: FrameType | None) -> None:
            ended.append(number)
            works.end()
            server.should_exit, server.force_exit = True, len(ended) > 1
            # Answers that are given up are no errors.
            logging.getLogger("uvicorn.error").setLevel(logging.CRITICAL)

        for name in _SIGNALS:
            signal.signal(getattr(signal, name), end)
        threading.Thread(target=_warm_up_until, args=(bench, start, lang, works), daemon=True).start()
        with tempfile.TemporaryDirectory(prefix="dondolo-") as folder:
            print(f"{address}\nThe page is for this computer only. Ctrl-C ends it.", flush=True)
            if is_opened:
                # A browser in the terminal ends when the user leaves it.
                threading.Thread(target=_open, args=(Path(folder), address), daemon=True).start()
            server.run(sockets=[listener])
    if ended:
        _leave(ended[0])


def _leave(number: int) -> NoReturn:
    """End the process, as it must within a second or two, whatever its threads compute: nothing of it is left."""
    if number == signal.SIGINT:
        print("dondolo: interrupted", file=sys.stderr, flush=True)
    # The exit code of other commands after Ctrl-C, and of shells for what a signal has ended
    os._exit(1 if number == signal.SIGINT else 128 + number)


def _warm_up_until(bench: Bench, start: Mapping[str, Any], lang: str, works: Works) -> None:
    with works.begun() as stop:
        warm_up(bench, start, lang, stop)


def warm_up(bench: Bench, start: Mapping[str, Any], lang: str, stop: threading.Event | None = None) -> None:
    """Compute the curve that the page begins with while the browser starts: loading SciPy takes longer than a curve."""
    with contextlib.suppress(DondoloError, Interrupted):
        bench.curve({"settings": start, "auto": "levels" not in start.get("stripes", {}), "lang": lang}, stop)


def beginning_of(case: str | None, records: str | None, threads: int) -> tuple[Bench, dict[str, Any]]:
    """What computes, and the groups that the page begins with."""
    if case is None:
        bench = Bench(_catalogue(records), threads)
        return bench, dict(_FIRST)
    path = Path(case)
    if records is None:
        import dondolo as dd

        read = dd.read_case(path)
        if read.task != "stripes":
            raise other_task(read)
        named = read.settings["records"]["catalogue"]
        bench = Bench((path.parent / str(named)).resolve(), threads)
    else:
        bench = Bench(_catalogue(records), threads)
    return bench, bench.open(read_text(path))


def _catalogue(records: str | None) -> Path:
    """Path of the catalogue that is given, or of the synthetic records."""
    from dondolo.records.examples import example_catalogue

    return example_catalogue() if records is None else Path(records).resolve()


def _open(folder: Path, address: str) -> None:
    """Open the browser by a file that only the user reads: arguments of a process are read by all."""
    path = folder / "open.html"
    with open(os.open(path, os.O_WRONLY | os.O_CREAT | os.O_EXCL, 0o600), "w", encoding="utf-8") as file:
        file.write(f'<!doctype html><meta charset="utf-8"><meta http-equiv="refresh" content="0; url={address}">')
    try:
        webbrowser.open(path.as_uri())
    except webbrowser.Error:
        print("no browser: open the address above", file=sys.stderr)


# A parapet of the synthetic records' towns, to begin with
_FIRST: dict[str, dict[str, Any]] = {
    "job": {"task": "stripes"},
    "wall": {"mechanism": "one_sided", "height": 6.0, "thickness": 0.5},
    "records": {"polarity": "both"},
    "stripes": {"im": "pga"},
    "check": {"ag": [0.2], "f0": [2.5], "tc_star": [0.35], "soil": "B", "knowledge_factor": 1.2},
}
