"""A function as C: statements, and where its variables are declared."""

import ast
import re
from collections.abc import Callable

from .c_expressions import SUM, Expressions, Made, function_name
from .c_program import C_TYPES, Function, Program, pairs, refuse

_WIDTH = 100
_TAB = "    "
_PLACES_TO_FOLD = re.compile(r"(?<=,) | (?=(?:[-+*/?:]|&&|\|\|) )")
_OPERATORS = {ast.Add: "+=", ast.Sub: "-=", ast.Mult: "*=", ast.Div: "/="}
_NOTHING = {"float": "0.0", "int": "0", "bool": "false"}


def prototype(program: Program, function: Function, spelled: Callable[[str], str]) -> str:
    """The head of a function, without what ends it."""
    given = []
    for name, kind in function.parameters.items():
        reads = kind == "array" and name not in program.written[function.name]
        kind = C_TYPES["constant array" if reads else kind]
        given.append(f"{kind}{'' if kind.endswith('*') else ' '}{spelled(name)}")
    head = f"{C_TYPES[function.returns]} {function_name(function.name)}"
    return f"{head}({', '.join(given) or 'void'})"


def folded(line: str) -> str:
    """A line of C in several where it is long, behind commas and before operators."""
    indent = line[: len(line) - len(line.lstrip())]
    parts = _PLACES_TO_FOLD.split(line.strip())
    lines = [indent + parts[0]]
    for part in parts[1:]:
        if len(lines[-1]) + 1 + len(part) <= _WIDTH:
            lines[-1] += f" {part}"
        else:
            lines.append(f"{indent}{2 * _TAB}{part}")
    return "\n".join(lines)


def comment(text: str) -> list[str]:
    """Lines of a comment that says a docstring."""
    lines = text.replace("*/", "* /").replace("/*", "/ *").split("\n")
    if len(lines) == 1:
        return [f"/* {lines[0]} */"]
    return [f"/* {lines[0]}", *(f" * {line}".rstrip() for line in lines[1:]), " */"]


class Statements:
    """The statements of a function, line by line."""

    def __init__(self, program: Program, function: Function, helpers: set[str]) -> None:
        self.program, self.function, self.where = program, function, function.where
        self.made = Expressions(program, function, helpers)
        self.head = prototype(program, function, self.made.name)
        self.lines: list[str] = []
        self.depth = 0

    def text(self) -> str:
        """Comment, head and body of the function."""
        body = self.function.node.body
        said = ast.get_docstring(self.function.node)
        self.lines += comment(said) if said is not None else []
        self._line(f"{self.head} {{")
        self.depth += 1
        self._begin(body)
        for statement in body[said is not None :]:
            self._statement(statement)
        self.depth -= 1
        if self.function.returns != "none" and not _ends(body):
            refuse(self.where, body[-1], "the function can end here without a value")
        self._line("}")
        return "\n".join(self.lines)

    def _begin(self, body: list[ast.stmt]) -> None:
        """Declare what its first assignment cannot; say which arguments are for others."""
        self.homes: dict[str, ast.stmt] = {}
        for name, kind in self.made.of_names.items():
            if name in self.function.parameters:
                if not any(mentions(statement, name) for statement in body):
                    self._line(f"(void){self.made.name(name)};")
            elif not _is_of_loops_only(self.function.node, name):
                home = _home(body, name)
                if home is not None:
                    self.homes[name] = home
                elif kind in _NOTHING:
                    self._line(f"{C_TYPES[kind]} {self.made.name(name)} = {_NOTHING[kind]};")

    def _line(self, text: str) -> None:
        self.lines.append(folded(_TAB * self.depth + text))

    def _lines_before(self) -> None:
        """The lines that the expressions made so far need before their statement."""
        for line in self.made.before:
            self._line(line)
        self.made.before.clear()

    def _block(self, body: list[ast.stmt]) -> None:
        self.depth += 1
        for statement in body:
            self._statement(statement)
        self.depth -= 1

    def _statement(self, node: ast.stmt) -> None:
        match node:
            case ast.Assign(targets=targets, value=value):
                self._assign(node, targets, value)
            case ast.AugAssign():
                self._assign_with(node)
            case ast.If():
                self._if(node)
            case ast.While(test=test, body=body, orelse=[]):
                with self.made.only_sometimes():
                    self._line(f"while ({self.made.condition(test).text}) {{")
                self._block(body)
                self._line("}")
            case ast.For(target=ast.Name(id=name), orelse=[]):
                self._for(node, name)
            case ast.Return(value=value):
                self._return(node, value)
            case ast.Expr(value=ast.Call() as call):
                text = self.made.made(call).text
                self._lines_before()
                self._line(f"{text};")
            case ast.Break():
                self._line("break;")
            case ast.Continue():
                self._line("continue;")
            case ast.Pass():
                pass
            case _:
                refuse(self.where, node)

    def _assign(self, node: ast.stmt, targets: list[ast.expr], value: ast.expr) -> None:
        """All that is given is evaluated before the first target gets any of it."""
        given = [pair for target in targets for pair in pairs(target, value)]
        if len(targets) == 1 and len(given) == 1:
            self._assign_one(node, *given[0])
            return
        values = self._all_given(node, targets, value, given)
        self._lines_before()
        for (target, each), one in zip(given, values, strict=True):
            self._store(node, target, each, one)

    def _all_given(
        self,
        node: ast.stmt,
        targets: list[ast.expr],
        value: ast.expr,
        given: list[tuple[ast.expr, ast.expr]],
    ) -> list[Made]:
        """The values of an assignment to many, kept where an earlier target may change them."""
        if len(targets) > 1:
            if isinstance(value, ast.Tuple):
                refuse(self.where, node, "several tuples")
            one = self.made.made(value)
            plain = isinstance(value, (ast.Constant, ast.Name))
            return [one if plain else self.made.kept(value, one)] * len(targets)
        values = self.made.in_order([each for _, each in given])
        for i, (_, each) in enumerate(given):
            if any(self._may_change(target, each) for target, _ in given[:i]):
                values[i] = self.made.kept(each, values[i])
        return values

    def _may_change(self, target: ast.expr, value: ast.expr) -> bool:
        if isinstance(target, ast.Name):
            return mentions(value, target.id)
        return self.program.touches(value)

    def _assign_one(self, node: ast.stmt, target: ast.expr, value: ast.expr) -> None:
        if isinstance(target, ast.Subscript) and self.program.order_matters(value, target.slice):
            one = self.made.kept(value, self.made.made(value))
        else:
            one = self.made.made(value)
        self._store(node, target, value, one)

    def _store(self, node: ast.stmt, target: ast.expr, value: ast.expr, made: Made) -> None:
        place, kind = self._place(node, target)
        text = self.made.as_type(value, made, kind).text
        self._lines_before()
        declared = isinstance(target, ast.Name) and self.homes.get(target.id) is node
        self._line(f"{f'{C_TYPES[kind]} ' if declared else ''}{place} = {text};")

    def _place(self, node: ast.stmt, target: ast.expr) -> tuple[str, str]:
        """What is assigned to, in C, and its type."""
        match target:
            case ast.Name(id=name) if self.made.of_names[name] in _NOTHING:
                return self.made.name(name), self.made.of_names[name] or ""
            case ast.Subscript(value=ast.Name(id=name)):
                if self.made.of_names.get(name) == "array":
                    return self.made.made(target).text, "float"
        refuse(self.where, node, "assigned to what is neither a variable nor an element")

    def _assign_with(self, node: ast.AugAssign) -> None:
        """As one operator of C where that does the same; the old value comes before the new."""
        target, value = node.target, node.value
        if isinstance(target, ast.Subscript) and self.program.writes(node):
            if self.program.touches(target.slice):
                refuse(self.where, node, "an index that may change meanwhile")
        place, kind = self._place(node, target)
        made = self.made.made(value)
        simple = type(node.op) in _OPERATORS and not self.program.order_matters(target, value)
        if simple and made.type in ("int", kind) and kind != "bool":
            text = self.made.as_type(value, made, kind).text
            self._lines_before()
            self._line(f"{place} {_OPERATORS[type(node.op)]} {text};")
            return
        self.made.before.clear()
        whole = ast.copy_location(ast.BinOp(target, node.op, value), node)
        self._assign_one(node, target, whole)

    def _if(self, node: ast.If, begin: str = "") -> None:
        test = self.made.condition(node.test).text
        self._lines_before()
        self._line(f"{begin}if ({test}) {{")
        self._block(node.body)
        match node.orelse:
            case []:
                self._line("}")
            case [ast.If(test=other) as more] if not self.program.writes(other):
                self._if(more, "} else ")
            case more:
                self._line("} else {")
                self._block(more)
                self._line("}")

    def _for(self, node: ast.For, name: str) -> None:
        """The counter is the variable itself, where Python's own counter cannot be told from it."""
        start, stop, step = self._range(node)
        alone = _is_of_loops_only(self.function.node, name)
        counter = self.made.name(name) if alone else self.made.new_name(f"next_{name}")
        first, last = (self.made.typed(each, "int").within(SUM) for each in (start, stop))
        self._lines_before()
        begin = f"int64_t {counter} = {first}"
        if not self._stays(stop, node.body):
            begin += f", {(end := self.made.new_name(f'{counter}_end'))} = {last}"
            last = end
        sign = "<" if step > 0 else ">"
        go_on = {1: "++", -1: "--"}.get(step, f" += {step}")
        self._line(f"for ({begin}; {counter} {sign} {last}; {counter}{go_on}) {{")
        if not alone:
            place, kind = self._place(node, node.target)
            now = self.made.as_type(node.target, Made(counter, "int"), kind).text
            self._line(f"{_TAB}{place} = {now};")
        self._block(node.body)
        self._line("}")

    def _range(self, node: ast.For) -> tuple[ast.expr, ast.expr, int]:
        match node.iter:
            case ast.Call(func=ast.Name(id="range"), args=given, keywords=[]):
                if any(self.program.writes(each) for each in given):
                    refuse(self.where, node, "a range by what writes into an array")
                match given:
                    case [stop]:
                        return ast.copy_location(ast.Constant(0), node), stop, 1
                    case [start, stop]:
                        return start, stop, 1
                    case [start, stop, step]:
                        return start, stop, self._step(node, step)
        refuse(self.where, node, "loops go over range()")

    def _step(self, node: ast.For, step: ast.expr) -> int:
        sign, size = 1, step
        if isinstance(step, ast.UnaryOp) and isinstance(step.op, ast.USub):
            sign, size = -1, step.operand
        value: object = size.value if isinstance(size, ast.Constant) else None
        if isinstance(size, ast.Name) and size.id not in self.made.of_names:
            value = self.program.constants.get(size.id)
        if not isinstance(value, int) or value == 0:
            refuse(self.where, node, "the step of a range is a whole constant")
        return sign * value

    def _stays(self, bound: ast.expr, body: list[ast.stmt]) -> bool:
        """Whether a bound is the same whenever the loop looks at it."""
        parts = list(ast.walk(bound))
        if any(isinstance(part, (ast.Call, ast.Subscript)) for part in parts):
            return False
        names = {part.id for part in parts if isinstance(part, ast.Name)}
        return not any(stores(statement, name) for statement in body for name in names)

    def _return(self, node: ast.Return, value: ast.expr | None) -> None:
        kind = self.function.returns
        if value is None or kind == "none":
            if value is not None or kind != "none":
                refuse(self.where, node, f"the function gives {kind}, as its head says")
            self._line("return;")
            return
        text = self.made.typed(value, kind).text
        self._lines_before()
        self._line(f"return {text};")


def mentions(node: ast.AST, name: str) -> bool:
    """Whether a variable is read or assigned to."""
    return any(isinstance(each, ast.Name) and each.id == name for each in ast.walk(node))


def stores(node: ast.AST, name: str) -> bool:
    """Whether a variable is assigned to."""
    return any(
        isinstance(each, ast.Name) and each.id == name and isinstance(each.ctx, ast.Store)
        for each in ast.walk(node)
    )


def _is_of_loops_only(function: ast.FunctionDef, name: str) -> bool:
    """Whether a variable is known within loops that count with it only, and only read there."""
    if any(each.arg == name for each in function.args.args):
        return False
    inside = set()
    for loop in _loops_with(function, name):
        if any(stores(statement, name) for statement in loop.body):
            return False
        parts = [loop.target, *(each for part in loop.body for each in ast.walk(part))]
        inside |= {id(part) for part in parts}
    known = (each for each in ast.walk(function) if isinstance(each, ast.Name) and each.id == name)
    return all(id(each) in inside for each in known)


def _loops_with(function: ast.FunctionDef, name: str) -> list[ast.For]:
    """Loops that count with a variable."""
    loops = (each for each in ast.walk(function) if isinstance(each, ast.For))
    return [each for each in loops if isinstance(each.target, ast.Name) and each.target.id == name]


def _home(block: list[ast.stmt], name: str) -> ast.stmt | None:
    """The assignment before all other use of a variable, in a block that holds all use of it."""
    users = [statement for statement in block if mentions(statement, name)]
    match users:
        case [ast.Assign(targets=targets, value=value) as first, *_]:
            given = [one for target in targets for one, _ in pairs(target, value)]
            own = [one for one in given if isinstance(one, ast.Name) and one.id == name]
            others = [one for one in given if one not in own and mentions(one, name)]
            return first if len(own) == 1 and not others and not mentions(value, name) else None
        case [ast.If() | ast.While() | ast.For() as only]:
            inner = [each for each in (only.body, only.orelse) if _any_mentions(each, name)]
            head = [part for part in ast.iter_child_nodes(only) if not isinstance(part, ast.stmt)]
            if len(inner) == 1 and not any(mentions(part, name) for part in head):
                return _home(inner[0], name)
    return None


def _any_mentions(block: list[ast.stmt], name: str) -> bool:
    return any(mentions(statement, name) for statement in block)


def _ends(block: list[ast.stmt]) -> bool:
    """Whether a block returns in any case."""
    match block[-1] if block else None:
        case ast.Return():
            return True
        case ast.If(body=body, orelse=orelse):
            return _ends(body) and _ends(orelse)
    return False
