"""The module that Python loads is linked as the program is: what makes a mistake in memory hard to use."""

from __future__ import annotations

import re
import shutil
import subprocess

import pytest

from stampede import _core

READELF = shutil.which("readelf")


@pytest.mark.skipif(READELF is None, reason="readelf is not installed")
def test_the_module_binds_all_at_once_and_neither_stack_nor_tables_can_be_bent() -> None:
    asked = [str(READELF), "--segments", "--dynamic", "--dyn-syms", "--wide", str(_core.__file__)]
    said = subprocess.run(asked, check=True, capture_output=True, text=True).stdout
    assert "GNU_RELRO" in said
    assert re.search(r"\bBIND_NOW\b|FLAGS_1.*\bNOW\b", said)
    assert re.search(r"GNU_STACK .* RW +0x", said)
    assert not re.search(r"^ +LOAD .* RWE ", said, re.MULTILINE)
    assert "TEXTREL" not in said
    assert "__stack_chk_fail" in said
    assert "__snprintf_chk" in said or "__memcpy_chk" in said
