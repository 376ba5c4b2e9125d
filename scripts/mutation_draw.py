"""Single faults that can be made in C++ sources, found by their text, and their order in a draw.

A fault replaces a span of a file by another text: of an expression, whose value is then taken from either text, or of
a statement, which either acts or does not. Where a file is not what clang-format makes of it, less is found.
"""

import hashlib
import re
from typing import NamedTuple

ON = "::platen::fault::on"


class Fault(NamedTuple):
    file: str  # below the root of the sources
    begin: int  # offsets of the span in the file
    end: int
    kind: str
    text: str  # in place of the span; empty: the statement is left out
    statement: bool

    def line(self, source):
        return source.count("\n", 0, self.begin) + 1


def masked(source):
    """The source with comments, texts and lines of the preprocessor blanked, as long as before."""

    def blank(match):
        return re.sub(r"[^\n]", " ", match.group())

    pattern = r'//[^\n]*|/\*.*?\*/|"(?:\\.|[^"\\\n])*"|\'(?:\\.|[^\'\\\n])\'|^[ \t]*#(?:\\\n|[^\n])*'
    return re.sub(pattern, blank, source, flags=re.DOTALL | re.MULTILINE)


OPENING, CLOSING = "([{", ")]}"
PAIR = dict(zip(CLOSING, OPENING))


def closed_by(code, at):
    """Where the bracket that opens at `at` closes."""
    depth = 0
    for k in range(at, len(code)):
        depth += (code[k] in OPENING) - (code[k] in CLOSING)
        if depth == 0:
            return k
    return len(code) - 1


def opened_by(code, at):
    depth = 0
    for k in range(at, -1, -1):
        depth += (code[k] in CLOSING) - (code[k] in OPENING)
        if depth == 0:
            return k
    return 0


def untouched(code):
    """Spans where no fault is made: what is written down or refused, heads of loops, what only the compiler reads."""
    spans = []
    for pattern in (r"\bfor \(", r"\bstatic_assert\(", r"\brequire\w*\(", r"\brefuse\("):
        for m in re.finditer(pattern, code):
            spans.append((m.start(), closed_by(code, m.end() - 1)))
    for pattern in (r"\bthrow\b[^;]*;", r"\busing\b[^;]*;", r"\benum\b[^;]*;", r"\btemplate <[^;{(]*?>\s",
                    r"\bcase [^:]*:", r"\[\[[^\]]*\]\]", r"\bif constexpr \([^\n]*"):
        spans += [m.span() for m in re.finditer(pattern, code)]
    for m in re.finditer(r"\bdescribe\w*\([^;{}]*\)[\w\s]*\{", code):
        spans.append((m.start(), closed_by(code, m.end() - 1)))
    return sorted(spans)


WORD_STOP = re.compile(r"\b(return|else|case|if|while)$")


PRODUCT, SUM, RELATION, BOTH, EITHER = range(5)  # operators by how tightly they bind


def stops(code, k, level):
    """Whether the operands of an operator of this level end at the character k outside of brackets."""
    c, pair = code[k], code[k : k + 2]
    if c in ",;?":
        return True
    if c == ":":
        return code[k - 1] != ":" and pair != "::"
    if c == "=":
        return level < BOTH or not (code[k - 1] in "=!<>" or pair == "==")
    if c in "&|" and (c + c in (pair, code[k - 1 : k + 1])):
        return level < BOTH or level == BOTH and c == "|"
    if c in "<>" and (c + c in (pair, code[k - 1 : k + 1])) and (code[k + 2].isspace() or code[k + 1].isspace()):
        return code[k - 1].isspace() or code[k - 2].isspace()
    spaced = code[k - 1].isspace() and code[k + 1 : k + 2].isspace()
    if c in "<>" and spaced:
        return level < BOTH
    return level == PRODUCT and c in "+-" and spaced


def left_of(code, at, level):
    """Where the expression that ends before `at` begins."""
    k = at - 1
    while k >= 0:
        c = code[k]
        if c in CLOSING:
            opening = opened_by(code, k)
            if c == "}" and not (code[opening - 1].isalnum() or code[opening - 1] in ">_"):
                break
            k = opening - 1
            continue
        if c in OPENING or stops(code, k, level):
            break
        if c.isspace() and WORD_STOP.search(code[max(0, k - 8) : k]):
            break
        k -= 1
    k += 1
    while k < at and code[k].isspace():
        k += 1
    return k


def right_of(code, at, level):
    k = at
    while k < len(code):
        c = code[k]
        if c == "{" and not (code[k - 1].isalnum() or code[k - 1] in ">_"):
            break
        if c in OPENING:
            k = closed_by(code, k) + 1
            continue
        if c in CLOSING or stops(code, k, level):
            break
        k += 1
    while k > at and code[k - 1].isspace():
        k -= 1
    return k


def chain_left_of(code, at):
    """Where the chain of names, members and calls that ends before `at` begins."""
    k = at
    while k > 0:
        c = code[k - 1]
        if c.isalnum() or c in "_.":
            k -= 1
        elif c in ")]":
            k = opened_by(code, k - 1)
        elif code[k - 2 : k] in ("->", "::"):
            k -= 2
        else:
            break
    return k


def chain_right_of(code, at):
    k = at
    while k < len(code):
        c = code[k]
        if c.isalnum() or c in "_.":
            k += 1
        elif c in "([":
            k = closed_by(code, k) + 1
        elif code[k : k + 2] in ("->", "::"):
            k += 2
        else:
            break
    return k


def statement_around(code, at):
    """The statement without its first else or label, semicolon included."""
    k = at - 1
    while k >= 0:
        if code[k] in ")]":
            k = opened_by(code, k) - 1
            continue
        if code[k] in ";{}([" or code[k] == ":" and code[k - 1] != ":" and code[k + 1] != ":":
            break
        k -= 1
    begin = k + 1
    begin += len(re.match(r"\s*(?:else\b\s*)?", code[begin:]).group())
    end = at
    while end < len(code) and code[end] != ";":
        if code[end] in CLOSING:
            return None
        end = closed_by(code, end) + 1 if code[end] in OPENING else end + 1
    return begin, end + 1


def arguments(code, opening):
    """Spans of the arguments within brackets, and where these close."""
    close, spans, begin, k = closed_by(code, opening), [], opening + 1, opening + 1
    while k < close:
        if code[k] in OPENING:
            k = closed_by(code, k)
        elif code[k] == ",":
            spans.append((begin, k))
            begin = k + 1
        k += 1
    spans.append((begin, close))
    return [code[a:b].strip() for a, b in spans], close


def changed_number(text, indexing):
    """Another number of the same type; None for those that stand for round-off or for nothing."""
    if re.search(r"[eE]", text) or text.lower().startswith("0x"):
        return None
    if "." in text:
        value = float(text)
        return repr(2 * value) if value else "1.0"
    value = int(text)
    return str(value + 1 if indexing or value < 2 else 2 * value)


SWAPS = {"i": "j", "j": "i", "ri": "rj", "rj": "ri", "wi": "wj", "wj": "wi", "torque_i": "torque_j",
         "torque_j": "torque_i", "turn_i": "turn_j", "turn_j": "turn_i", "first": "second", "second": "first",
         "bottom_end": "top_end", "top_end": "bottom_end", "top": "bottom", "bottom": "top", "front": "back",
         "back": "front", "x": "y", "y": "z", "z": "x"}
CALLS = {"std::min": "std::max", "std::max": "std::min", "std::fmin": "std::fmax", "std::fmax": "std::fmin",
         "std::sin": "std::cos", "std::cos": "std::sin", "norm": "norm_squared", "norm_squared": "norm"}
DROPPED = ("std::abs", "positive_part", "std::sqrt", "root", "magnitude", "std::clamp", "larger", "std::tan",
           "std::atan", "std::asin")


def found(file, source):
    """All faults that can be told by the text."""
    code = masked(source)
    faults = []

    def add(kind, begin, end, text, statement=False):
        faults.append(Fault(file, begin, end, kind, " ".join(text.split()), statement))

    for m in re.finditer(r"\s([+\-*/])\s", code):
        at = m.start(1)
        if not re.search(r"[\w)\]}.]\s*$", code[max(0, at - 200) : at]):
            continue
        sums = m.group(1) in "+-"
        level = SUM if sums else PRODUCT
        begin, end = left_of(code, at, level), right_of(code, at + 1, level)
        other = {"+": "-", "-": "+", "*": "/", "/": "*"}[m.group(1)]
        add("sign" if sums else "factor", begin, end, code[begin:at] + other + code[at + 1 : end])
        if sums:
            term = right_of(code, at + 1, PRODUCT)
            add("forgotten term", begin, end, code[begin:at] + code[term:end])
    for m in re.finditer(r"(?<![\w.])([\w.]+(?:\[\w+\])?) \* \1(?![\w.\[(])", code):
        add("power", m.start(), m.end(), m.group(1))
    for m in re.finditer(r"(?:[(,=?:+\-*/] ?|return |\[)(-)(?=[\w(])", code):
        end = chain_right_of(code, m.end())
        add("sign", m.start(1), end, code[m.end() : end])
    for m in re.finditer(r"\s(<=|>=|<|>)\s", code):
        begin, end = left_of(code, m.start(1), RELATION), right_of(code, m.end(1), RELATION)
        other = m.group(1).translate(str.maketrans("<>", "><"))
        add("bound", begin, end, code[begin : m.start(1)] + other + code[m.end(1) : end])
    for m in re.finditer(r"\s(&&|\|\|)\s", code):
        level = BOTH if m.group(1) == "&&" else EITHER
        begin, end = left_of(code, m.start(1), level), right_of(code, m.end(1), level)
        add("forgotten condition", begin, end, code[begin : m.start(1)])
    for m in re.finditer(r"\bif (\()", code):
        close = closed_by(code, m.start(1))
        inner = code[m.end(1) : close]
        if not re.search(r"\b(auto|const)\b|[^=!<>]=[^=]", inner):
            add("forgotten condition", m.end(1), close, "false")
    for m in re.finditer(r"(?<![\w.])(\d+\.?\d*(?:[eE][+-]?\d+)?)(?![\w.])", code):
        indexing = code[m.start() - 1] == "[" and code[m.end()] == "]"
        if (text := changed_number(m.group(1), indexing)) is not None:
            add("index" if indexing else "factor", m.start(), m.end(), text)
    for m in re.finditer(r"(?<![\w.>])((?:std::)?\w+)\(", code):
        name = m.group(1)
        if name in CALLS:
            close = closed_by(code, m.end() - 1) + 1
            add("min for max" if "min" in name or "max" in name else "power", m.start(), close,
                CALLS[name] + code[m.end() - 1 : close])
        elif name in DROPPED:
            given, close = arguments(code, m.end() - 1)
            add("bound" if name in ("std::clamp", "positive_part", "larger") else "power", m.start(), close + 1,
                "(" + given[0] + ")")
        elif name == "cross":
            given, close = arguments(code, m.end() - 1)
            if len(given) == 2:
                add("sign", m.start(), close + 1, f"cross({given[1]}, {given[0]})")
    for m in re.finditer(r"(?<=[\w)\]]\.)[xyz]\b(?!\()|\b[ij]\b|\b(?:[rw][ij]|\w+_[ij]|first|second|bottom_end|top_end"
                         r"|top|bottom|front|back)\b", code):
        name = m.group()
        declared = re.search(r"(\w+|[>&*]) [&*]?$", code[max(0, m.start() - 40) : m.start()])
        if name not in SWAPS or declared and declared.group(1) not in ("return", "else"):
            continue
        begin, end = chain_left_of(code, m.start()), m.end()
        if name in ("front", "back"):
            if code[end : end + 2] != "()":
                continue
            end += 2
        add("index", begin, end, code[begin : m.start()] + SWAPS[name] + code[m.end() : end])
    for m in re.finditer(r"\s([+\-*/])=\s", code):
        span = statement_around(code, m.start(1))
        if span is None:
            continue
        begin, end = span
        other = {"+": "-", "-": "+", "*": "/", "/": "*"}[m.group(1)]
        add("forgotten term", begin, end, "", True)
        add("sign" if m.group(1) in "+-" else "factor", begin, end,
            code[begin : m.start(1)] + other + code[m.end(1) : end], True)
    skipped = untouched(code)
    return [f for f in faults if f.begin < f.end and not any(a < f.end and f.begin < b for a, b in skipped)]


def switched(source, numbered):
    """The source with every fault behind its number; on as many lines as before."""
    edits = []
    for number, f in numbered:
        original, acting = source[f.begin : f.end], f"{ON}({number})"
        if f.statement and not f.text:
            new = f"if (!{acting}) {{ {original} }}"
        elif f.statement:
            new = f"{{ if ({acting}) {{ {f.text} }} else {{ {original} }} }}"
        elif f.kind == "forgotten condition" and f.text == "false":
            new = f"!{acting} && ({original})"
        else:
            new = f"({acting} ? ({f.text}) : ({original}))"
        edits.append((f.begin, f.end, new))
        line = source.rfind("\n", 0, f.begin) + 1
        head = re.match(r"\s*(?:static |inline )*(constexpr)\b", source[line : f.begin])
        if head and not f.statement:
            at = line + head.start(1)
            edits.append((at, at + len("constexpr"), "const"))
    for begin, end, new in sorted(set(edits), reverse=True):
        source = source[:begin] + new + source[end:]
    return source


def rank(seed, source, fault):
    """Its place in the draw: of the fault and its line alone, so that changes elsewhere move no other."""
    line = source[source.rfind("\n", 0, fault.begin) + 1 : source.find("\n", fault.end)]
    key = "|".join((str(seed), fault.file, fault.kind, " ".join(line.split()), fault.text))
    return hashlib.sha256(key.encode()).hexdigest()


def draw(seed, sources, files, taken, count, refused):
    """`count` faults of `files` that lie apart from each other and from those `taken`, kinds and files in turn.

    `refused(fault)` tells which do not compile.
    """
    left = {}
    for file in files:
        for fault in found(file, sources[file]):
            if not refused(fault):
                left.setdefault(fault.kind, []).append(fault)
    for faults in left.values():
        faults.sort(key=lambda f: rank(seed, sources[f.file], f), reverse=True)
    drawn, of_file = [], {}
    while len(drawn) < count and any(left.values()):
        for kind in sorted(left):
            if len(drawn) == count or not left[kind]:
                continue
            fewest = min(of_file.get(f.file, 0) for f in left[kind])
            at = max(k for k, f in enumerate(left[kind]) if of_file.get(f.file, 0) == fewest)
            fault = left[kind].pop(at)
            if all(f.file != fault.file or fault.end <= f.begin or f.end <= fault.begin for f in taken + drawn):
                drawn.append(fault)
                of_file[fault.file] = of_file.get(fault.file, 0) + 1
    return drawn
