"""Reading the runs of run.sh and writing tables: what table.py and curves.py share."""
import csv
import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "python"))
import platen


def summaries(folder, pattern):
    """summary.json of the runs whose name fits, by name."""
    return {name: run.summary for name, run in platen.runs(folder, pattern).items() if run.status}


def figure(summary, path):
    """The number at a/b/c of a summary, None where it was not measured."""
    for key in path.split("/"):
        summary = (summary or {}).get(key)
    return summary


def text(value):
    """A cell as the programs write it: the shortest digits that give the number."""
    return value if isinstance(value, str) else repr(value).removesuffix(".0")


def write(path, header, rows):
    with open(path, "w", newline="") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(header)
        writer.writerows(rows)
