# SPDX-License-Identifier: LGPL-2.1-or-later
"""Values and names that a user may write by mistake or on purpose."""
import re

NUMBERS = [
    "0", "-0.0", "-1", "1", "2", "3", "0.5", "1e-310", "5e-324", "2.2250738585072014e-308", "1e308", "1e309", "-1e309",
    "1e-30", "1e30", "1e-400", "255", "65536", "2147483648", "4294967295", "4294967296", "18446744073709551616",
    "0.1000000000000000055511151231257827", "9007199254740993", "123456789.123456789", "3.", ".5", "+5", "--5", "+-5",
    "-+5", "1e", "1e+", "1.5.2", "1e5.5", "0x10", "0x1p3", "0x", "1d5", "1f", "1_000", "1'000", "1 000", "1 5",
    "nan", "-nan", "NaN(1)", "inf", "-inf", "infinity", "INF"]
LISTS = [
    "1,5", "0,5", "-1,5", "1,4e6", "1.5,", ",5", "1,,5", "1;5", "1;", ";", ",", "0, 0", "0, 0, 0", "0; 0", "0; 0; 0",
    "1, 2, 3, 4", "(1,5)", "(1, 0)", "1,5, 2,5", "nan, nan", "0, inf"]
EXPRESSIONS = [
    "1/3", "2*pi", "1/0", "-1/0", "0/0", "sqrt(-1)", "log(0)", "10^400", "2^-1", "-2^2", "2^3^2", "x", "y", "z", "t",
    "t+1", "x*t", "y/(x-x)", "if(t>1,1,2)", "if(1,5)", "if(x<0.5,1,0)", "x<0.5", "1<2", "1&&0", "!1", "a", "e", "_e",
    "_pi", "rand()", "rand_seed(1)", "1+rand()", "sin(x", "sin x", "sin()", "sin(1,2)", "max(1,2)", "min()", "atan2(1,2)",
    "int(1.7)", "1?2:3", "x=1", "pi=3", "1+", "*1", "()", "(", ")", ")(", "1)+(1", "\"1\"", "1%2", "exp(1000)",
    "abs(-1)", "cos(t)", "1e3*t", "pow(2,3)", "erf(1)", "2pi", "2 pi", "pi pi", "floor(1e300)", "1//2", "1**2"]
TEXTS = [
    "", " ", "\\", "\\\\", "a\\", "\\#", "# 1", "a # b", "a\\#b", "\"", "'", "\"1\"", "'1'", "true", "false", "TRUE", "yes",
    "auto", "none", "default", "0 # none", "a=b", "=", "==", "%s%n%d", "%", "{}", "{0}", "${HOME}", "$(id)", "`id`",
    "<a>&amp;</a>", "&", "]]>", "..", "../", "/", "/dev/null", "/dev/zero", "/dev/stdin", ".", "~", "*", "a/b", "-", "--",
    "é", "名前", "½", "１２", "٣", "1\u00a0000", "–5", "1\u2212 2", "1×2", "\u200b1", "\u202e1", "1\t2", "\x01", "\x1b[31m1",
    "\x7f", "\udcff", "\udcc3(", "\x00", "\x0b1", "1\x0c", "1\r", "left", "top", "left, left", "left, right, left",
    "box", "ball", "gmsh", "particle", "clamp", "neo-Hookean"]
NAMES = [
    "a b", "a\"b<c", "a'b", "a&b", "a]]>b", "a\\#b", "a\\\\b", "a\\", "a#b", "a/b", "a=b", "a;b", "a,b", "a:b", "a.b", "a..b",
    "..", ".", "-", "--set", "é", "名前", "a\u202eb", "\udcff", "a\tb", "a\x01b", "a\x1b[31mb", "%s", "{0}", "time", "Fluid",
    "Bodies", "end", "set a", "subsection", "include", "nan", "1", "0", "true", "x", "t", "a" * 300, "a" * 5000, "velocity",
    "pressure", "displacement", "step", "NUL", "a*b", "a|b", "a?b", "<a>", "[a]", "(a)", " a ", "a  b", "#", "\\", "\""]


def long_value(rng):
    length = rng.choice((100, 1000, 20000, 100000))
    return rng.choice((
        "1" * length, "0." + "0" * length + "1", "(" * length + "1" + ")" * length, "1+" * length + "1",
        "a" * length, "1," * length + "1", "-" * length + "1", "sin(" * length + "1" + ")" * length,
        " " * length + "1", "1e" + "9" * length, "x^" * length + "2", "\\\\" * length, "if(x," * length + "1"))


def random_number(rng):
    mantissa = rng.choice((rng.uniform(-10, 10), rng.uniform(0, 1), rng.randrange(-5, 50)))
    return f"{mantissa:.{rng.choice((1, 3, 17))}g}e{rng.randrange(-20, 20)}"


def changed_number(rng, word):
    """A plain number made a bit or much different, or written in another way."""
    try:
        value = float(word)
    except ValueError:
        return rng.choice(NUMBERS)
    return rng.choice((
        f"-{word}", f"{value * 2:g}", f"{value / 3!r}", f"{value * 1e3:g}", f"{value * 1e-3:g}", f"{value + 1:g}",
        f"{value:.3e}", word.replace(".", ","), f"{word},5", f"{word} {word}", f"{word}{word}", word[:-1], f"{word}e9",
        f"{word}e-9", f"1/{word}", f"({word})", f"{word}+x", f"{word}*t", f"{word} m", f"{word}%", "0"))


def changed_value(rng, value, others):
    """`others`: values that occur in scenes."""
    kind = rng.randrange(10)
    words = list(re.finditer(r"[\d.]+(?:[eE][-+]?\d+)?", value))
    if kind <= 3 and words:
        word = rng.choice(words)
        return value[:word.start()] + changed_number(rng, word[0]) + value[word.end():]
    parts = re.split(r"([,;])", value)
    if kind == 4 and len(parts) > 1:
        return changed_list(rng, parts)
    if kind == 5:
        return rng.choice(others)
    if kind == 6 and value:
        at = rng.randrange(len(value))
        return value[:at] + rng.choice(("", ",", ";", "#", "\\", "(", ")", ".", "-", "\"", "é", " ", "\t")) + value[at + 1:]
    if kind == 7 and rng.random() < 0.3:
        return long_value(rng)
    if kind == 8 and len(parts) > 1:
        parts[2 * rng.randrange((len(parts) + 1) // 2)] = rng.choice(NUMBERS + EXPRESSIONS)
        return "".join(parts)
    return rng.choice((rng.choice(NUMBERS), rng.choice(LISTS), rng.choice(EXPRESSIONS), rng.choice(TEXTS),
                       random_number(rng)))


def changed_list(rng, parts):
    """Entries and separators in turn: one less, one more, exchanged, or separated otherwise."""
    entries, separators = parts[::2], parts[1::2]
    kind = rng.randrange(5)
    if kind == 0:
        del entries[rng.randrange(len(entries))]
    elif kind == 1:
        entries.append(rng.choice(entries))
    elif kind == 2:
        entries.reverse()
    elif kind == 3:
        return rng.choice((" ", ", ", ";", ",,", "\t", ": ")).join(entries)
    else:
        return "".join(parts) + rng.choice((",", ";", " ,", ", 0"))
    return (separators[0] + " ").join(entries)
