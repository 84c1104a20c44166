"""Links in the prose lead somewhere; addresses outside are well-formed but not visited."""

import re
import subprocess
from pathlib import Path
from urllib.parse import urlsplit

import pytest

ROOT = Path(__file__).resolve().parents[1]
LINK = re.compile(r"!?\[[^\]]*\]\(([^)\s]+)\)")
FENCED = re.compile(r"^```.*?^```$", re.MULTILINE | re.DOTALL)
CODE = re.compile(r"^```.*?^```$|`[^`\n]+`", re.MULTILINE | re.DOTALL)
HEADING = re.compile(r"^#+ (.*)$", re.MULTILINE)
# Paths in code that prose names. Those with a wildcard or a placeholder are left out.
NAMED = re.compile(r"`((?:src|docs|tests|config|workflow|benchmarks|profiles|\.ci)/[\w./-]+)`")
BUILT = {"docs/reference/modules/modules.rst", "docs/_build/html"}
OF_A_READER = {"config/lines/harbour.yaml", "config/lines/dresden.yaml"}
FOLDERS = ("config", "docs", "tests", "benchmarks", "workflow")
PAGES = sorted(
    page
    for page in (*ROOT.glob("*.md"), *(p for name in FOLDERS for p in (ROOT / name).rglob("*.md")))
    if "_build" not in page.parts
)


def anchor(heading: str) -> str:
    """The name that a heading gets as the target of links."""
    return re.sub(r"[^\w\- ]", "", heading.lower()).replace(" ", "-")


def broken(page: Path, target: str) -> str:
    """What is wrong with a link, nothing if it is sound."""
    parts = urlsplit(target)
    if parts.scheme:
        return "" if parts.scheme == "https" and "." in parts.netloc else "no address"
    path = (page.parent / parts.path).resolve() if parts.path else page
    if not path.exists() and path.relative_to(ROOT).as_posix() not in BUILT:
        return "no such file"
    if parts.fragment:
        headings = HEADING.findall(FENCED.sub("", path.read_text(encoding="utf-8")))
        return "" if parts.fragment in map(anchor, headings) else "no such heading"
    return ""


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.relative_to(ROOT).as_posix())
def test_links_lead_somewhere(page: Path) -> None:
    text = CODE.sub("", page.read_text(encoding="utf-8"))
    wrong = {link: fault for link in LINK.findall(text) if (fault := broken(page, link))}

    assert not wrong


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.relative_to(ROOT).as_posix())
def test_files_that_prose_names_exist(page: Path) -> None:
    named = set(NAMED.findall(page.read_text(encoding="utf-8"))) - BUILT - OF_A_READER
    assert [name for name in named if not (ROOT / name).exists()] == []


@pytest.mark.parametrize(
    ("target", "fault"),
    [
        ("config/README.md#all-keys", ""),
        ("config/README.md#all-kyes", "no such heading"),
        ("config/READ.md", "no such file"),
        ("https://semver.org/spec", ""),
        ("http://semver.org", "no address"),
    ],
)
def test_a_broken_link_is_found(target: str, fault: str) -> None:
    assert broken(ROOT / "README.md", target) == fault


def test_every_page_is_checked() -> None:
    listed = subprocess.run(
        ["git", "-C", ROOT, "ls-files", "*.md"], capture_output=True, text=True
    ).stdout.split()
    assert {ROOT / name for name in listed} <= set(PAGES)
