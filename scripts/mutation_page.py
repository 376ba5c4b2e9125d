"""The page of single faults (mutation.py): what each was, and what has killed it."""

import re


def written(result, before):
    """The list as a page of Markdown."""
    was = {}
    if before is not None:
        was = {(f["file"], f["before"], f["after"]): f for f in before["faults"]}
    rows = []

    def cell(text):
        text = text.replace("|", "\\|")
        return f"`{text if len(text) < 90 else text[:87] + '...'}`" if text else "left out"

    def verdict(f):
        if f is None:
            return "not drawn"
        if not f["killed"]:
            return "**survived**"
        return {"expectation": "", "crash": "crash: ", "time": "time: "}.get(f["killed"], "") + f["by"].split(" ")[-1]

    for f in result["faults"]:
        row = [str(f["number"]), f"{f['file']}:{f['line']}", f["name"] or f["kind"], cell(f["before"]), cell(f["after"])]
        if before is not None:
            old = was.get((f["file"], f["before"], f["after"]))
            row.append("killed" if old and old["killed"] else verdict(old))
        row.append(verdict(f) if f["killed"] or not f["argument"] else "**survives**: " + f["argument"])
        rows.append("| " + " | ".join(row) + " |")
    head = ["", "where", "fault", "text", "becomes"] + (["before"] if before is not None else []) + ["killed by"]
    survivors = sum(not f["killed"] for f in result["faults"])
    ways = {way: sum(f["killed"] == way for f in result["faults"]) for way in ("expectation", "crash", "time")}
    lines = ["# Single faults, and the tests that notice them", "",
             f"{len(result['faults'])} faults, seed {result['seed']}: {survivors} survive, {ways['expectation']} are "
             f"killed by an expectation, {ways['crash']} by a crash, {ways['time']} by time.", ""]
    if before is not None:
        lived = sum(not (was.get((f["file"], f["before"], f["after"])) or {"killed": 1})["killed"]
                    for f in result["faults"])
        lines += [f"Before, {lived} of them survived.", ""]
    lines += ["| " + " | ".join(head) + " |", "|" + "---|" * len(head)] + rows
    return "\n".join(lines) + "\n"


def renewed(said, page):
    """The page, with what an older one says above its list."""
    begin = [re.search(r"^\d+ faults, seed", text, re.MULTILINE) for text in (said, page)]
    return said[: begin[0].start()] + page[begin[1].start() :] if all(begin) else page
