"""What of an office's file of Word comes into a report: styles, pages, headers; no macros, nothing of other files."""

from __future__ import annotations

import io
import os
import zipfile
import zlib
from typing import Any

from dondolo._base.arguments import argument_error
from dondolo._base.files import read_bytes
from dondolo.errors import InputError

# Bytes and parts of a template once it is unpacked
_LARGEST, _MOST = 2**28, 5000
# Bytes of its XML, which takes many times that in memory
_LARGEST_XML = 2**25
_CONTENT_TYPES = "[Content_Types].xml"
_MAIN = "application/vnd.openxmlformats-officedocument.wordprocessingml.document.main+xml"
# A template, and one with macros, becomes a document
_MAINS = (
    "application/vnd.openxmlformats-officedocument.wordprocessingml.template.main+xml",
    "application/vnd.ms-word.document.macroEnabled.main+xml",
    "application/vnd.ms-word.template.macroEnabledTemplate.main+xml",
)
# Kinds of parts that come along: what is drawn and written. All others run something, or hold other files
_KEPT = {
    "officeDocument", "styles", "stylesWithEffects", "numbering", "settings", "webSettings", "fontTable", "font",
    "theme", "themeOverride", "header", "footer", "footnotes", "endnotes", "comments", "image", "chart",
    "chartUserShapes", "chartStyle", "chartColorStyle", "diagramData", "diagramLayout", "diagramQuickStyle",
    "diagramColors", "diagramDrawing", "glossaryDocument", "customXml", "customXmlProps", "core-properties",
    "extended-properties", "custom-properties", "thumbnail",
}  # fmt: skip
_RUNS = {"vbaProject", "wordVbaData", "extensibility", "keyMapCustomizations", "attachedToolbars", "control"}
# Elements that stay without what they refer to: words and frames
_STAY = ("hyperlink", "blip", "imagedata")
# Fields that Word computes from the document alone
_FIELDS = {
    "PAGE", "NUMPAGES", "SECTION", "SECTIONPAGES", "DATE", "TIME", "CREATEDATE", "SAVEDATE", "PRINTDATE",
    "EDITTIME", "TITLE", "SUBJECT", "AUTHOR", "KEYWORDS", "COMMENTS", "LASTSAVEDBY", "REVNUM", "FILENAME",
    "FILESIZE", "NUMWORDS", "NUMCHARS", "DOCPROPERTY", "INFO", "USERNAME", "USERINITIALS", "USERADDRESS",
    "STYLEREF", "SEQ", "TOC", "TC", "XE", "INDEX", "REF", "PAGEREF", "NOTEREF", "SYMBOL", "LISTNUM", "FORMTEXT",
    "FORMCHECKBOX", "FORMDROPDOWN",
}  # fmt: skip
_RELATIONSHIPS = (
    "{http://schemas.openxmlformats.org/officeDocument/2006/relationships}",
    "{http://purl.oclc.org/ooxml/officeDocument/relationships}",
)


class _NoTemplateError(ValueError):
    """A file of Word that is no template: its sentence says why."""


def open_template(path: str | os.PathLike[str]) -> tuple[Any, list[str]]:
    """A template as a document of python-docx, and what was left out of it, in words.

    Raises
    ------
    InputError
        Not a file of Word; one whose XML declares a document type, or that is far too large once unpacked.
    """
    import docx

    def refused(reason: Exception) -> InputError:
        words = " ".join(str(reason).split()) or type(reason).__name__
        what = "" if isinstance(reason, _NoTemplateError) else "is not a file of Word: "
        return argument_error("out_of_range", "template", f" = {os.fspath(path)!r}: {what}{words}")

    try:
        parts = _unpacked(read_bytes(path))
        left_out = _cleaned(parts)
        made = io.BytesIO()
        with zipfile.ZipFile(made, "w") as archive:
            for name, content in parts.items():
                archive.writestr(name, content)
        file = docx.Document(made)
        # Without it nothing can be written, whatever the styles
        _ = file.styles["Normal"], file.sections[0]
        file.save(io.BytesIO())
    except InputError:
        raise
    except (ValueError, LookupError, AttributeError, TypeError, SyntaxError, RuntimeError, EOFError) as error:
        # What zipfile, lxml and python-docx raise of files that are damaged
        raise refused(error) from None
    except (zipfile.BadZipFile, zlib.error) as error:
        raise refused(error) from None
    return file, left_out


def _unpacked(content: bytes) -> dict[str, bytes]:
    """Parts of a file of Word by their names."""
    with zipfile.ZipFile(io.BytesIO(content)) as archive:
        members = [one for one in archive.infolist() if not one.is_dir()]
        sizes = {_is_xml(one.filename): 0 for one in members} | {True: 0}
        for one in members:
            sizes[_is_xml(one.filename)] += one.file_size
        if len(members) > _MOST or sum(sizes.values()) > _LARGEST or sizes[True] > _LARGEST_XML:
            raise _NoTemplateError(
                f"has {len(members)} parts and {sum(sizes.values()) / 2**20:.3g} MB once unpacked,"
                f" {sizes[True] / 2**20:.3g} MB of XML: must have at most {_MOST} and {_LARGEST // 2**20} MB,"
                f" {_LARGEST_XML // 2**20} MB of XML"
            )
        return {one.filename: archive.read(one) for one in members}


def _is_xml(name: str) -> bool:
    return name.lower().endswith((".xml", ".rels", ".vml"))


def _cleaned(parts: dict[str, bytes]) -> list[str]:
    """Leave out of the parts, in place, what must not come along; gives it in words."""
    from lxml import etree

    parser = etree.XMLParser(resolve_entities=False, no_network=True, load_dtd=False)
    trees: dict[str, Any] = {}
    for name, content in parts.items():
        if _is_xml(name):
            # In UTF-16 every other byte is 0
            if b"<!DOCTYPE" in content.replace(b"\0", b""):
                raise _NoTemplateError(
                    f"{name} has a document type declaration (DOCTYPE), which files of Word do not have"
                )
            trees[name] = etree.fromstring(content, parser)
    left_out = set()
    for name, tree in trees.items():
        if name == _CONTENT_TYPES:
            for one in tree:
                if one.get("ContentType") in _MAINS:
                    one.set("ContentType", _MAIN)
        elif name.endswith(".rels"):
            folder, _, file = name.rpartition("_rels/")
            gone = {}
            for one in list(tree):
                kind = one.get("Type", "").rpartition("/")[2]
                is_link = one.get("TargetMode") == "External"
                if is_link or kind not in _KEPT:
                    what = "links" if is_link else "macros" if kind in _RUNS else "embedded files"
                    gone[one.get("Id")] = what
                    tree.remove(one)
            left_out |= set(gone.values())
            _forget(trees.get(folder + file.removesuffix(".rels")), gone)
        else:
            left_out |= _without_fields(tree)
    parts |= {name: etree.tostring(tree, encoding="UTF-8", xml_declaration=True) for name, tree in trees.items()}
    return sorted(left_out)


def _forget(tree: Any, gone: dict[str, str]) -> None:
    """Remove from a part what refers to parts and files that are left out."""
    if tree is None:
        return
    for element in list(tree.iter("{*}*")):
        if element.getparent() is not None and _local(element) == "mailMerge":
            element.getparent().remove(element)
        for name, value in list(element.attrib.items()):
            if name.startswith(_RELATIONSHIPS) and value in gone:
                if _local(element) in _STAY:
                    del element.attrib[name]
                elif element.getparent() is not None:
                    element.getparent().remove(element)
                    break


def _without_fields(tree: Any) -> set[str]:
    """Turn fields that look into other files, or run something, into what they show."""
    found: set[str] = set()
    stack: list[tuple[list[Any], list[Any]]] = []
    for element in list(tree.iter("{*}*")):
        name = _local(element)
        if name == "fldSimple" and not _is_kept(_value(element, "instr")):
            parent, place = element.getparent(), element.getparent().index(element)
            for inner in reversed(list(element)):
                parent.insert(place, inner)
            parent.remove(element)
            found.add("fields")
        elif name == "fldChar":
            kind = _value(element, "fldCharType")
            if kind == "begin":
                stack.append(([], []))
            if stack:
                stack[-1][0].append(element)
            if kind == "end" and stack:
                signs, words = stack.pop()
                if not _is_kept("".join(one.text or "" for one in words)):
                    for one in (*signs, *words):
                        one.getparent().remove(one)
                    found.add("fields")
        elif name == "instrText" and stack:
            stack[-1][1].append(element)
    return found


def _is_kept(instruction: str) -> bool:
    """Whether a field is computed from the document alone."""
    return bool(words := instruction.split()) and words[0].upper() in _FIELDS


def _value(element: Any, name: str) -> str:
    """An attribute of Word's own namespace."""
    return next((value for key, value in element.attrib.items() if key.rpartition("}")[2] == name), "")


def _local(element: Any) -> str:
    return str(element.tag).rpartition("}")[2]
