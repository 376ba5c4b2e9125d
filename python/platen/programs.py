"""Platen's programs, called from Python: where they are, and what ended badly as an exception."""
import re
import shutil
import signal
import subprocess
from pathlib import Path

from .errors import InputError, NumericsError, OutputError, PlatenError

# "file:line: error: Section/Key = value ...": file, line, reason, entry; each but the reason may be missing.
_FAULT = re.compile(r"^(?:(.*?)(?::(\d+))?: )?error: ((?:([A-Z][\w ]*/[\w /]+?) (?:=|is) )?.*)", re.M)


def program(name):
    """Path of a program: of the build or the installation that this package belongs to, otherwise of PATH."""
    parents = Path(__file__).resolve().parents
    beside = (parents[2] / "apps" / name, parents[min(4, len(parents) - 1)] / "bin" / name)
    found = next((str(path) for path in beside if path.is_file()), None) or shutil.which(name)
    if found is None:
        raise PlatenError(f"{name} is not found, neither beside the package nor in PATH. Install the Debian package platen, or add the "
                          "folder of the programs (build/apps) to PATH")
    return found


def call(name, *arguments):
    """Runs a program to its end and returns its exit status, 0 or 1 (a figure is not as the scene expects). Other statuses are exceptions.
    Ctrl-C stops it as in a terminal, with a checkpoint of each run."""
    process = subprocess.Popen([program(name), *arguments], stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE,
                               text=True, errors="replace", start_new_session=True)  # a second SIGINT would end it without checkpoints
    try:
        text = process.communicate()[1].strip()
    except BaseException:
        process.send_signal(signal.SIGINT)
        process.communicate()
        raise
    status, faults = process.returncode, list(_FAULT.finditer(text))
    if status in (0, 1):
        return status
    if status == 2 and faults:
        fault = next((fault for fault in faults if fault[4]), faults[0])
        raise InputError(text, fault[4], fault[1], fault[2] and int(fault[2]), fault[3])
    raise {2: InputError, 3: NumericsError, 4: OutputError}.get(status, PlatenError)(text or f"{name} ended with status {status}")
