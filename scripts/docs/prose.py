"""Numbers and options in the prose of a page: its commands print the numbers, and the program has the options.

A number of prose is right when a number of the page's commands, or of what they print, rounds to the digits that it shows.
Whole numbers up to ten are free. Others must be given, with a reason or as an expression of numbers that are printed:

    <!-- given: 90 (right angle), 9.81, 1013 (https://…), 1.8 = 3.77e-2 / 2.08e-2 -->
"""

import ast
import math
import operator
import re

NUMBER = re.compile(r"(?<![\w★^])(?<![A-Za-z_][-./])(?<!\d[.,])"
                    r"(?:(?:(?P<mantissa>\d+(?:\.\d+)?) ?[×·] ?)?10(?P<power>[⁻⁰¹²³⁴⁵⁶⁷⁸⁹]+)"
                    r"|(?P<plain>\d{1,3}(?:,\d{3})+(?:\.\d+)?|\d+(?:\.\d+)?)(?:e(?P<exponent>[-+]?\d+))?)(?![\w⁰-⁹²³]|[.,]\d|\()")
PRINTED = re.compile(r"\d{1,3}(?:,\d{3})+(?!\d)(?:\.\d+)?|(?:\d+(?:\.\d*)?|\.\d+)(?:e[-+]?\d+)?")
SUPERSCRIPT = str.maketrans("⁻⁰¹²³⁴⁵⁶⁷⁸⁹", "-0123456789")
UNITS = {"%": 0.01, "km": 1e3, "cm": 1e-2, "mm": 1e-3, "ms": 1e-3, "kB": 1e3, "MB": 1e6, "GB": 1e9, "°": 0.017453292519943295,
         "thousand": 1e3, "million": 1e6, "billion": 1e9}  # fmt: skip
UNIT = re.compile(r"[ \n]?(%|°|(?:km|cm|mm|ms|kB|MB|GB|thousand|million|billion)\b)")
GIVEN = re.compile(r"<!-- given: (.*?) -->", re.S)
GIVE = re.compile(r"(\d[\d.,]*(?:e[-+]?\d+)?(?:,\s+\d[\d.,]*(?:e[-+]?\d+)?)*)\s*(?:\((?P<reason>[^()]+(?:\([^()]*\)[^()]*)*)\)|= (?P<formula>[-+*/() \d.e]+))(?:,\s*|$)")
MONTH = r"(?:January|February|March|April|May|June|July|August|September|October|November|December)"
NOT_PROSE = [re.compile(pattern, re.M | re.S) for pattern in (
    r"^(?P<fence> *)```.*?^ *```[ \t]*$", r"<!-- written by .*?<!-- end -->", r"<!-- ([\w ]+) -->.*?<!-- /\1 -->", r"<!--.*?-->",
    r"\$\$.*?\$\$", r"(`+)(?!`).*?\1", r"\$[^$\n]+\$", r"<[a-z/][^<>]*>",
    r"(?<!!)\[[^\[\]]*\]\([^()\s]*\)", r"\]\([^()\s]*\)", r"https?://\S+", r"^#+ [\d.]+ ", r"^ *\d+\. ", r"\[\^\w+\]",
    r"(?<=\n\n)(?:    [^\n]*\n)+",
    r"\d{4}-\d\d-\d\d", rf"(?:\d{{1,2}} )?{MONTH}(?: \d{{1,2}},)?(?: \d{{4}})?",
    r"(?i:\b(?:in|since) )(?:19|20)\d\d\b(?! \w+s\b)", r"(?:\(|, )(?:19|20)\d\d(?=[).,;:])",
    r"(?i:\b(?:Debian|Ubuntu|Python|Clang|GCC|EPSG|versions?|Algorithms?|Figures?|Figs?\.|Sections?|Tables?|Design)[: ]|§ ?)"
    r"\d[\d.]*(?:(?:, | and |, and | to |[–-])\d[\d.]*)*", r"\b\d+-bit\b",
    r"\b[A-Za-z]\w*[-+]+\d[\w.]*")]
# A number beside one of these is a part of an equation.
EQUATION_BEFORE = re.compile(r"(?:[=<>≤≥≈]\s*[-−]?|(?:\b\w(?:\w|_\w+)?|[)|′²]) ?(?:[·/*]|[+−](?= )) ?)$")
EQUATION_AFTER = re.compile(r"\s*[=<>≤≥≈]|\s?[+−·/*]\s?(?:[^\W\d]\w?(?!\w)|[(|√])")
OPTION = re.compile(r"(?<![\w-])--[a-z][\w-]*")
SETTING = re.compile(r"--set[ =]([a-z]\w*=[^\s`;&|]*)")


def blanked(text, pattern):
    return pattern.sub(lambda match: re.sub(r"[^\n]", " ", match[0]), text)


def numbers_in(text):
    """Of commands and what they print."""
    return {abs(float(number.replace(",", ""))) for number in PRINTED.findall(text)}


def value_of(text):
    """The value that a matched number has, and the unit of its last digit."""
    if text["power"]:
        digits, exponent = text["mantissa"] or "1", int(text["power"].translate(SUPERSCRIPT))
    else:
        digits, exponent = text["plain"].replace(",", ""), int(text["exponent"] or 0)
    return float(digits) * 10.0**exponent, 10.0 ** (exponent - len(digits.partition(".")[2]))


def rounds_to(value, unit, known):
    return any(abs(number - value) <= unit / 2 * (1 + 1e-9) for number in known)


def computed(formula):
    operations = {ast.Add: operator.add, ast.Sub: operator.sub, ast.Mult: operator.mul, ast.Div: operator.truediv}

    def value(node):
        if isinstance(node, ast.BinOp):
            return operations[type(node.op)](value(node.left), value(node.right))
        return -value(node.operand) if isinstance(node, ast.UnaryOp) else float(node.value)

    try:
        return value(ast.parse(formula.strip(), mode="eval").body)
    except (SyntaxError, KeyError, AttributeError, TypeError, ValueError, ZeroDivisionError):
        return math.nan


def wrong_numbers(text, known):
    """(line, why) of every number in the prose of a page that is none of the known ones."""
    def line(at):
        return text.count("\n", 0, at) + 1

    given, used = {}, set()
    for comment in GIVEN.finditer(text):
        at, rest = line(comment.start()), GIVE.sub("", comment[1]).strip()
        if rest:
            yield at, f"'{rest}' gives no reason: write NUMBER (REASON) or NUMBER = EXPRESSION"
        for give in GIVE.finditer(comment[1]):
            formula = give["formula"] or ""
            for number in re.split(r",\s+", give[1]):
                match = NUMBER.fullmatch(number)
                value, unit = value_of(match) if match else (0, 0)
                if formula and not rounds_to(value, unit, [abs(computed(formula))]):
                    yield at, f"{number} is given as {formula.strip()}, which is {computed(formula):.4g}: correct it"
                given[value] = (number, at)
            for part in numbers_in(formula) - known:
                if part > 10 or part != int(part):
                    yield at, f"{part:g} in the expression of {give[1]} is printed by no command: correct it"
    prose, wrong = text, {}
    for pattern in NOT_PROSE:
        prose = blanked(prose, pattern)
    for match in NUMBER.finditer(prose):
        value, unit = value_of(match)
        scale = UNITS.get((UNIT.match(prose, match.end()) or "  ")[1], 1)
        equation = EQUATION_AFTER.match(prose, match.end()) or EQUATION_BEFORE.search(prose[max(0, match.start() - 9) : match.start()])
        if value in given:
            used.add(value)
        elif not (value <= 10 and unit == 1 or equation or rounds_to(value, unit, known) or rounds_to(value * scale, unit * scale, known)):
            wrong.setdefault(line(match.start()), []).append(match[0])
    for at, numbers in wrong.items():
        yield at, (f"{', '.join(numbers)}: no command of the page prints this; correct it, say it in words, or declare "
                   f"<!-- given: {numbers[0]} (REASON) -->")
    shown = blanked(text, GIVEN)
    for value in (value for value in given.keys() - used if given[value][0] not in shown):
        yield given[value][1], f"{given[value][0]} is given, but not in the prose: remove it"


def wrong_options(text, commands, options, settings):
    """(line, why) of every option in inline code and in commands [(line, text)] that the program does not have.

    options: of each verb; settings: names for --set, called when there is one.
    """
    pieces = [(text.count("\n", 0, match.start()) + 1, match[2])
              for match in re.finditer(r"(`+)(?!`)([^`\n]+)\1(?!`)", blanked(text, NOT_PROSE[0]))] + commands
    every = set().union(*options.values())
    for line, piece in pieces:
        for command in re.split(r"[;|&\n]+", piece.replace("\\\n", " ")):
            words = command.split()
            if not words or not (words[0] == "temper" or words[0].startswith("-")):  # of other programs
                continue
            verb = next((" ".join(words[1:n]) for n in (3, 2) if " ".join(words[1:n]) in options), "")
            known = options[verb] if words[0] == "temper" and verb else every
            for option in dict.fromkeys(OPTION.findall(command)):
                if option not in known:
                    yield line, f"{'temper ' + verb if known is not every else 'the program'} has no option {option}: name one that it has"
            for setting in SETTING.findall(command):
                for name in (part.partition("=")[0] for part in setting.split(",") if "=" in part):
                    if name not in settings():
                        yield line, f"--set {name}: there is no such option of optimize: name one that it has"
