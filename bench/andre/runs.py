"""Reading the runs of run.sh and writing tables: what table.py and curves.py share."""
import csv
import json


def summaries(folder, pattern):
    """summary.json of the runs whose name fits, by name."""
    paths = sorted(folder.glob(pattern + "/summary.json"))
    return {p.parent.name: json.loads(p.read_text()) for p in paths}


def figure(summary, path):
    """The number at a/b/c of a summary, None where it was not measured."""
    for key in path.split("/"):
        summary = (summary or {}).get(key)
    return summary


def write(path, header, rows):
    with open(path, "w", newline="") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(header)
        writer.writerows(rows)
