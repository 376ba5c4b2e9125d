"""Pages of the manual that the programs write of themselves: every entry of a scene, every option."""

import json
import pathlib
import re
import subprocess

PROGRAMS = ("platen-pack", "platen-bonds", "platen-bar", "platen-compress", "platen-brazilian", "platen-calibrate",
            "platen-study", "platen-report")
WITH_SCENES = PROGRAMS[:-1]
SOURCE = pathlib.Path(__file__).resolve().parent.parent


def sections_decide():
    """What each section decides, for the index and the head of its page: the table of docs/scene_files.md."""
    text = (SOURCE / "docs/scene_files.md").read_text(encoding="utf-8").split("\n## The sections\n")[1].split("\n#")[0]
    rows = re.findall(r"^\| (`.*?`) \| (.*) \|$", text, re.M)
    return {name: what[0].upper() + what[1:] + "." for names, what in rows for name in re.findall("`(.*?)`", names)}


def said(*command):
    return subprocess.run([str(word) for word in command], check=True, capture_output=True, text=True).stdout


def entries_of(tree, path=()):
    """Entries of the tree that --print-parameters --json writes: path and what is said of it."""
    for name, what in tree.items():
        if not isinstance(what, dict):
            continue
        if isinstance(what.get("documentation"), str):
            yield path + (name,), what
        else:
            yield from entries_of(what, path + (name,))


def all_entries(apps):
    """Path to what is said of it, in the order of the programs, and to the programs that read it."""
    entries, readers = {}, {}
    for program in WITH_SCENES:
        tree = json.loads(said(apps / program, "--print-parameters", "--json"))
        for path, what in entries_of(tree):
            entries.setdefault(path, what)
            readers.setdefault(path, []).append(program)
    return entries, readers


def file_of(section):
    return section.lower().replace(" ", "_")


def anchor_of(path):
    return re.sub(r"[^a-z0-9]+", "-", " ".join(path).lower()).strip("-")


def escaped(text):
    return re.sub(r"([\\`*_<>|\[\]#$])", r"\\\1", text)


class Links:
    """Entries that a text names become links to them."""

    def __init__(self, paths):
        self.place = {"/".join(path): f"{file_of(path[0])}.md#{anchor_of(path[1:])}" for path in paths}
        for path in paths:  # "Contact modulus" within its own section is not led: too many are plain words
            self.place.setdefault("/".join(path), "")
        names = sorted(self.place, key=len, reverse=True)
        self.pattern = re.compile("|".join(re.escape(name) for name in names) + r"|docs/(\w+)\.md")

    def led(self, text):
        parts, at = [], 0
        for match in self.pattern.finditer(text):
            place = f"../{match.group(1)}.md" if match.group(1) else self.place[match.group(0)]
            parts += [escaped(text[at:match.start()]), f"[{escaped(match.group(0))}]({place})"]
            at = match.end()
        return "".join(parts) + escaped(text[at:])


def value(text):
    return f"`{text}`" if text else "none"


def readers_of(programs):
    return "all programs" if len(programs) == len(WITH_SCENES) else ", ".join(programs)


def entry_text(path, what, programs, links):
    """Heading, meaning and a small table of an entry."""
    lines = [f"## {': '.join(path[1:])}", "",
             links.led(what["documentation"]), "",
             "| default | unit | allowed | read by |", "| --- | --- | --- | --- |",
             f"| {value(what['default_value'])} | {escaped(what['unit']) or '-'} | "
             f"{escaped(what['allowed']) or 'any text'} | {readers_of(programs)} |", ""]
    return "\n".join(lines)


def table_text(paths, entries, readers):
    """Entries that are alike, as rows: those of Expect."""
    lines = ["| entry | unit | read by |", "| --- | --- | --- |"]
    for path in paths:
        name = "/".join(path[1:])
        lines.append(f"| <a id=\"{anchor_of(path[1:])}\"></a>`{name}` | {escaped(entries[path]['unit']) or '-'} | "
                     f"{readers_of(readers[path])} |")
    return "\n".join(lines) + "\n"


def section_page(section, decides, paths, entries, readers, links):
    head = f"# {section}\n\n{decides}\n\n"
    if section == "Expect":
        words = links.led(entries[paths[0]]["documentation"])
        return head + f"{words}\n\n" + table_text(paths, entries, readers)
    return head + "\n".join(entry_text(path, entries[path], readers[path], links) for path in paths)


def scene_pages(apps):
    """Path of a page to its text: an index and one page for each section."""
    entries, readers = all_entries(apps)
    links = Links(entries)
    sections = {}
    for path in entries:
        sections.setdefault(path[0], []).append(path)
    decides = sections_decide()
    order = [name for name in decides if name in sections] + [s for s in sections if s not in decides]
    index = ["# Scene reference", "",
             f"All {len(entries)} entries of a scene, as the programs themselves tell them by `--print-parameters`. How a scene is "
             "written: [scenes and the command line](../scene_files.md).", "",
             "| section | entries | what it decides |", "| --- | --- | --- |"]
    for name in order:
        index.append(f"| [{name}]({file_of(name)}.md) | {len(sections[name])} | {decides.get(name, '')} |")
    index += ["", "```{toctree}", ":hidden:", ":maxdepth: 1", "", *map(file_of, order), "```", "", "## All entries", ""]
    for name in order:
        listed = sections[name] if name != "Expect" else []
        if listed:
            index.append(f"**{name}**: " + ", ".join(
                f"[{': '.join(p[1:])}]({file_of(name)}.md#{anchor_of(p[1:])})" for p in listed) + "\n")
    pages = {"scene/index.md": "\n".join(index) + "\n"}
    for name in order:
        pages[f"scene/{file_of(name)}.md"] = section_page(name, decides.get(name, ""), sections[name], entries, readers, links)
    return pages


def programs_page(apps):
    """What each program says of its options."""
    lines = ["# Programs and their options", "",
             "What each program tells by `--help`. Exit statuses and what the options mean in full: "
             "[the command line](scene_files.md#the-command-line).", ""]
    for program in ("platen", *PROGRAMS):
        lines += [f"## {program}", "", "```text", said(apps / program, "--help").strip(), "```", ""]
    return "\n".join(lines)


def library_page():
    return """# The library

Platen is a library with programs on top of it: `base` (vectors, tables, threads), `dem` (particles, bonds, contacts), `dist`
(ranks), `fem` (bodies of finite elements) and `coupling` (experiments). Their headers are described, class by class, in the

<p><a href="api/index.html"><strong>reference of the library</strong></a></p>

which begins with the list of files. Good places to start: `coupling/experiment.h` (an experiment: specimen, boundaries,
program), `coupling/boundary.h` (what a specimen may meet), `dem/model.h` (the specimen), `dem/bonds.h`. How the parts fit:
[architecture](architecture.md); what to write for a law, a boundary or a stage of your own: [extending](extending.md).
"""
