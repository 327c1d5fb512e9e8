"""Archives whose bytes depend on nothing but what is in them and SOURCE_DATE_EPOCH."""

import os
import time
import zipfile
from pathlib import Path

# What zip can tell: no day before
FIRST_TIME = 315_532_800


def write_archive(path: Path, members: dict[str, bytes]) -> None:
    """Write files by their names into a zip."""
    now = max(int(os.environ.get("SOURCE_DATE_EPOCH", time.time())), FIRST_TIME)
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED, compresslevel=9) as archive:
        for name in sorted(members):
            member = zipfile.ZipInfo(name, time.gmtime(now)[:6])
            member.compress_type = zipfile.ZIP_DEFLATED
            member.external_attr = 0o644 << 16
            archive.writestr(member, members[name], compresslevel=9)
