# SPDX-License-Identifier: LGPL-2.1-or-later
"""Numbers and expressions read independently of the program.

Knows the part of muParser's language that scenes use: numbers, names, + - * / ^, comparisons, logic, the
choice `a ? b : c`, and functions. Where it does not know what muParser would do it says so, rather than guess.
"""
import math
import re

PLAIN = re.compile(r"[+-]?(\d+\.?\d*|\.\d+)([eE][+-]?\d+)?\Z", re.ASCII)
HEXADECIMAL = re.compile(r"[+-]?0[xX]([0-9a-fA-F]+\.?[0-9a-fA-F]*|\.[0-9a-fA-F]+)([pP][+-]?\d+)?\Z", re.ASCII)
TOKEN = re.compile(r"\s*(?:(\d+\.?\d*(?:[eE][+-]?\d+)?|\.\d+(?:[eE][+-]?\d+)?)"
                   r"|([A-Za-z_]\w*)|(<=|>=|==|!=|&&|\|\||[-+*/^(),<>?:&|=!%]))", re.ASCII)
CONSTANTS = {"pi": math.pi, "_pi": math.pi, "_e": math.e}
FUNCTIONS = {  # name -> (numbers of arguments, function or None where the value is not computed here)
    "sin": math.sin, "cos": math.cos, "tan": math.tan, "asin": math.asin, "acos": math.acos,
    "atan": math.atan, "sinh": math.sinh, "cosh": math.cosh, "tanh": math.tanh, "exp": math.exp,
    "ln": math.log, "sqrt": math.sqrt, "abs": abs, "log10": math.log10, "log2": math.log2,
    "atan2": math.atan2, "min": min, "max": max, "sum": None, "avg": None, "sign": None, "rint": None,
    "log": None, "asinh": None, "acosh": None, "atanh": None, "if": None, "int": None, "ceil": None,
    "floor": None, "cot": None, "csc": None, "sec": None, "pow": math.pow, "erf": None, "erfc": None,
    "rand": None, "rand_seed": None}
DEEPEST = 60  # parentheses within each other
RANDOM = re.compile(r"\brand(_seed)?\b")


class NoExpression(Exception):
    """The text is certainly none."""


class Unknown(Exception):
    """Whether it is one, or what its value is, cannot be said here."""


class Expression:
    """The value of a text by recursive descent; names in `variables` may occur."""

    def __init__(self, text, variables):
        self.variables = variables
        self.names = set()
        self.known = True  # the value, not only the grammar
        self.tokens = []
        at = 0
        text = text.rstrip()
        while at < len(text):
            match = TOKEN.match(text, at)
            if not match:
                raise NoExpression(f"unexpected {text[at:at + 10]!r}")
            self.tokens.append(match)
            at = match.end()
        if any(token[3] in ("!", "%", "&", "|", "=") for token in self.tokens):
            raise Unknown
        self.at = 0
        self.depth = 0

    def peek(self):
        return self.tokens[self.at][3] if self.at < len(self.tokens) else None

    def accept(self, *signs):
        sign = self.peek()
        if sign is None or sign not in signs:
            return None
        self.at += 1
        return sign

    def expect(self, sign):
        if not self.accept(sign):
            raise NoExpression(f"{sign!r} is missing")

    def value(self):
        """Raises NoExpression; the value is None where it is not known."""
        if not self.tokens:
            raise NoExpression("nothing")
        result = self.choice()
        if self.at < len(self.tokens):
            raise NoExpression(f"unexpected {self.tokens[self.at][0].strip()!r}")
        return result if self.known else None

    def choice(self):
        self.depth += 1
        if self.depth > DEEPEST:
            raise Unknown
        result = self.chain(0)
        if self.accept("?"):
            self.known = False
            self.choice()
            self.expect(":")
            self.choice()
        self.depth -= 1
        return result

    LEVELS = (("||",), ("&&",), ("<=", ">=", "==", "!=", "<", ">"), ("+", "-"), ("*", "/"))

    def chain(self, level):
        """Operators of one rank, from the left."""
        if level == len(self.LEVELS):
            return self.power()
        result = self.chain(level + 1)
        sign = self.accept(*self.LEVELS[level])
        while sign:
            result = self.apply(sign, result, self.chain(level + 1))
            sign = self.accept(*self.LEVELS[level])
        return result

    def apply(self, sign, a, b):
        if sign not in "+-*/^":
            self.known = False
        try:
            return {"+": lambda: a + b, "-": lambda: a - b, "*": lambda: a * b, "/": lambda: a / b,
                    "^": lambda: math.pow(a, b)}.get(sign, lambda: 0.)()
        except (ArithmeticError, ValueError):
            self.known = False
            return 1.

    def power(self):
        if self.accept("-"):
            if self.peek() == "-" or self.peek() == "+":
                raise Unknown
            return -self.power()
        if self.accept("+"):
            raise Unknown
        base = self.operand()
        if self.accept("^"):
            return self.apply("^", base, self.power())
        return base

    def operand(self):
        if self.accept("("):
            result = self.choice()
            self.expect(")")
            return result
        if self.at >= len(self.tokens):
            raise NoExpression("it ends too early")
        token = self.tokens[self.at]
        self.at += 1
        if token[1]:
            return float(token[1])
        if token[2]:
            return self.name(token[2])
        raise NoExpression(f"unexpected {token[0].strip()!r}")

    def name(self, name):
        self.names.add(name)
        if name in CONSTANTS:
            return CONSTANTS[name]
        if name in self.variables:
            self.known = False
            return 1.
        if name not in FUNCTIONS:
            raise NoExpression(f"the name {name!r}")
        self.expect("(")
        arguments = [] if self.peek() == ")" else [self.choice()]
        while self.accept(","):
            arguments.append(self.choice())
        self.expect(")")
        function = FUNCTIONS[name]
        try:
            return float(function(*arguments))
        except (ArithmeticError, ValueError, TypeError):
            self.known = False
            return 1.


def constant(text):
    """The value of a text that must be a constant number; None if it is one whose value is not known here.

    Raises NoExpression, or Unknown."""
    if PLAIN.match(text):
        return float(text)
    if HEXADECIMAL.match(text):
        return float.fromhex(text)
    if RANDOM.search(text):
        raise NoExpression("random numbers")
    return Expression(text, ()).value()


def function_of(text, variables, n_components):
    """Raises NoExpression unless the text has so many expressions in these variables; Unknown."""
    parts = text.split(";")
    if len(parts) == 1 and "(" not in text and text.count(",") == n_components - 1:
        parts = text.split(",")
    if len(parts) > 1 and not parts[-1].strip():
        parts.pop()
    if len(parts) != n_components:
        raise NoExpression(f"{len(parts)} expressions instead of {n_components}")
    if RANDOM.search(text):
        raise NoExpression("random numbers")
    for part in parts:
        if not PLAIN.match(part.strip()):
            Expression(part, variables).value()
