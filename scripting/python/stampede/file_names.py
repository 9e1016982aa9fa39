"""Names of files that are made from data: of cameras, tasks, streams. The engine's rules (engine/base/file_name.h)."""

from __future__ import annotations

import hashlib
import unicodedata

_LONGEST = 160  # bytes; leaves room for an ending
_ELSEWHERE = set('/\\:*?"<>|%')  # the first separates here, all mean something somewhere
_HIDDEN = {"Cc", "Cf", "Cs", "Zl", "Zp"}  # what a terminal obeys, what turns or hides text
_DEVICES = {"con", "prn", "aux", "nul"} | {f"{port}{number}" for port in ("com", "lpt") for number in range(10)}


def file_name(text: str) -> str:
    """One part of a path, whatever the text is; two texts never have one.

    Separators, control characters, `%`, a dot, dash, tilde or blank at the beginning, a dot or blank at the end, and
    the first letter of names that some systems keep to themselves are %XX of their bytes. Long ones end in a hash.
    """
    if not text:
        return "%"
    reserved = text.split(".")[0].lower() in _DEVICES
    name, whole = "", ""
    for place, letter in enumerate(text):
        misplaced = (place == 0 and (letter in ".-~ " or reserved)) or (place == len(text) - 1 and letter in ". ")
        if misplaced or letter in _ELSEWHERE or unicodedata.category(letter) in _HIDDEN:
            letter = "".join(f"%{byte:02X}" for byte in letter.encode(errors="surrogatepass"))
        name += letter
        if len(name.encode()) + 18 <= _LONGEST:
            whole = name
    if len(name.encode()) <= _LONGEST:
        return name
    digest = hashlib.blake2b(text.encode(errors="surrogatepass"), digest_size=8).hexdigest()
    return f"{whole}%-{digest}"


class FileNames:
    """The names in one folder, told apart where a disk does not know large letters, and from what its owner writes."""

    def __init__(self, *taken: str) -> None:
        self._taken = {name.lower() for name in taken}

    def take(self, text: str) -> str:
        """A name that none before it had: file_name(text), with a number where that is taken."""
        name = chosen = file_name(text)
        number = 2
        while chosen.lower() in self._taken:
            chosen, number = f"{name}%~{number}", number + 1
        self._taken.add(chosen.lower())
        return chosen
