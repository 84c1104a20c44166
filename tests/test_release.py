"""The files that describe a release agree, and catalogues accept them."""

import datetime
import re
import tomllib
from pathlib import Path

import pytest
import yaml

CHANGE = re.compile(r"^## \[(\d+\.\d+\.\d+)\] - (\d{4}-\d\d-\d\d)$", re.MULTILINE)
# Of the schema of the Citation File Format 1.2.0.
REQUIRED = {"authors", "cff-version", "message", "title"}
ALLOWED = REQUIRED | {
    *("abstract", "commit", "contact", "date-released", "doi", "identifiers", "keywords"),
    *("license", "license-url", "preferred-citation", "references", "repository", "type"),
    *("repository-artifact", "repository-code", "url", "version"),
}


@pytest.fixture(scope="module")
def project(root: Path) -> dict:
    return tomllib.loads((root / "pyproject.toml").read_text())["project"]


@pytest.fixture(scope="module")
def citation(root: Path) -> dict:
    return yaml.safe_load((root / "CITATION.cff").read_text())


def test_versions_and_dates_agree(root: Path, project: dict, citation: dict) -> None:
    released = CHANGE.findall((root / "CHANGELOG.md").read_text())

    assert released[0] == (project["version"], citation["date-released"].isoformat())
    assert citation["version"] == project["version"]
    assert citation["license"] == project["license"]
    assert [a["name"] for a in citation["authors"]] == [a["name"] for a in project["authors"]]
    numbers = [tuple(map(int, version.split("."))) for version, _ in released]
    assert numbers == sorted(set(numbers), reverse=True)


def test_citation_follows_its_format(citation: dict) -> None:
    assert set(citation) >= REQUIRED
    assert set(citation) <= ALLOWED
    assert citation["cff-version"] == "1.2.0"
    assert citation["type"] == "software"
    assert isinstance(citation["date-released"], datetime.date)
    assert len(set(citation["keywords"])) == len(citation["keywords"])
    for author in citation["authors"]:
        assert set(author) == {"name"} or {"given-names", "family-names"} <= set(author)


def test_catalogue_of_workflows_finds_what_it_needs(root: Path) -> None:
    readme = (root / "README.md").read_text().lower()
    usage = yaml.safe_load((root / ".snakemake-workflow-catalog.yml").read_text())["usage"]

    assert "snakemake" in readme
    assert "workflow" in readme
    assert (root / "workflow/Snakefile").is_file()
    assert (root / "config/README.md").is_file()
    assert {path.suffix for path in (root / "workflow/rules").iterdir()} == {".smk"}
    assert set(usage) == {"mandatory-flags", "software-stack-deployment", "report"}
    assert set(usage["mandatory-flags"]) == {"desc", "flags"}
    assert set(map(type, usage["software-stack-deployment"].values())) == {bool}
    assert usage["report"] is True
