"""`stickslip belt-length`: its arguments, what it runs, what it leaves behind."""

import json
import sys
import time
from argparse import Namespace
from collections.abc import Iterable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import replace
from pathlib import Path
from typing import Any

from cosim.cli import DONE, FAILED, BadInput
from cosim.cli.bar import Bar
from cosim.cli.console import note
from cosim.cli.numbers import Numbers, numbers_asked
from cosim.cli.scenarios import given_scenario, note_taken
from cosim.manifest import made_by, own_folder, results_in
from cosim.scenario import Scenario
from cosim.studies import belt_length as belts
from cosim.studies.belt_length import cases, work_off
from cosim.studies.belt_length.lengths import length_text
from cosim.studies.belt_length.result import PRINTED
from cosim.studies.belt_length.show import page
from cosim.studies.belt_length.show.wording import two_digits
from cosim.studies.belt_length.study import BOUNDS, check_case, check_options, steps

#: The study's rig: speeds and lengths are varied, the rest is a case's default.
STUDY = belts.Case(1.0, 0.82)

#: The printed columns in words.
LEGEND = (
    "study: its single pass; drift: rise of the belt over the air where it enters the contact, at"
    " the end of the runs; low, high: 5 and 95 % of the doubt; steady: for ever; interface drift:"
    " what the interface warms by at constant speed; endless belt: on one that never comes round;"
    " ice: rise of its face; belt share: of the friction heat; wait: until belt and ice are within"
    " the limit again; mu change: of the kinetic friction by the interface's rise, relative."
)

#: The two questions, as tables have them.
COLD, STEADY = "comes round cold", "interface steady"

#: Choice -> the study's values; of the others it has the default case's.
STUDIED = {"length": (1.0, 2.0, 3.0, 4.0), "speed": (0.15, 0.5, 0.82)}


def execute(arguments: Namespace) -> int:
    """Compute, write, print; 0, or 1 when stopped: what there was by then is written."""
    began = time.perf_counter()
    scenario, wanted, options = _asked(arguments)
    numbers = numbers_asked(arguments, ("limit", "cases", "verdict"))
    own_files = (page.RESULT, page.TABLE, page.PAGE, page.CHANGES, page.DOUBT)
    folder = own_folder(arguments.output, own_files, arguments.force)
    if scenario is not None:
        _note(scenario)
    text, status = "" if scenario is None else scenario.to_toml(), DONE
    study = belts.Study(options, scenario=text)
    own = None if scenario is None else wanted[0]
    study.grid = belts.empty_map(arguments.map, own) if arguments.map else None
    try:
        with Bar(total=steps(study, wanted, own is not None), unit="run") as bar:
            if own is not None:
                belts.answer_all(study, wanted, arguments.jobs, bar.update)
            work_off(study, wanted, arguments.jobs, bar.update)
            if study.grid is not None:
                belts.fill_map(study.grid, wanted[0], arguments.jobs, bar.update)
    except KeyboardInterrupt:
        print(
            f"error: interrupted; {len(study.rows)} of {len(wanted)} cases are kept in {folder}",
            file=sys.stderr,
        )
        status = FAILED
    made = made_by(scenario=study.scenario or None)
    with results_in(folder, made, force=arguments.force) as results:
        page.write_numbers(study, folder)
        if status == DONE:
            page.write_page(study, folder, made["command"])
            results.complete = True
    _print(study, numbers, folder, time.perf_counter() - began)
    return status


def _asked(arguments: Namespace) -> tuple[Scenario | None, list[belts.Case], belts.Options]:
    """Scenario, cases and options, all of them checked before anything is computed."""
    check_options(arguments)
    scenario, base, source = None, STUDY, arguments.scenario
    if source is not None:
        scenario = given_scenario(source, arguments.changes)
        with _of_file(source):
            base = belts.scenario_case(scenario)
    elif arguments.changes:
        raise BadInput("--set: changes keys of a scenario, so a SCENARIO is needed with it")
    base = belts.with_ranges(replace(base, protocol=_protocol(base, arguments)), arguments.doubt)
    given = scenario is not None
    if arguments.map is None:
        arguments.map = 12 if given else 30
    choices = {}
    for name, (field, *_) in BOUNDS.items():
        asked = getattr(arguments, name)
        own = (getattr(base, field),) if given or name not in STUDIED else STUDIED[name]
        # of a value that is given twice one case
        choices[field] = own if asked is None else tuple(dict.fromkeys(asked))
    wanted = cases(base, **choices)
    for case in wanted:
        check_case(case, arguments)
        with _of_file(source):
            if scenario is not None:
                belts.check_slides(scenario, case)
    options = belts.Options(arguments.limit, arguments.sensitivity, arguments.samples)
    return scenario, wanted, options


@contextmanager
def _of_file(source: str) -> Iterator[None]:
    """Let faults of a scenario begin with its file."""
    try:
        yield
    except belts.StudyError as error:
        raise belts.StudyError(f"{source}: {error}") from None


def _note(scenario: Scenario) -> None:
    """What was taken, and what is computed otherwise."""
    note_taken(scenario)
    for remark in belts.remarks(scenario):
        note(remark)
    if keys := belts.ignored_keys(scenario):
        note(
            f"{', '.join(keys)}: ignored, belt-length has a resolution of its own;"
            " `stickslip run` heeds them"
        )


def _protocol(base: belts.Case, arguments: Namespace) -> belts.Protocol:
    """The base's, with what the options say."""
    said = {
        name: getattr(arguments, name)
        for name in ("ramp", "run", "pause")
        if getattr(arguments, name) is not None
    }
    return replace(base.protocol, runs=arguments.runs, lifted=arguments.lifted, **said)


def _print(study: belts.Study, asked: Numbers, folder: Path, wall_time: float) -> None:
    if asked.give(json.dumps(study.summary(), indent=1)):
        return
    if study.answers:
        _print_answers(study)
    elif study.rows:
        shown = study.table()[PRINTED]
        # what is asked for is printed as it is, what is found with as much as it is worth
        exact = {name: "{:g}".format for name in ("length [m]", "speed [m/s]")}
        print(shown.to_string(index=False, formatters=exact, float_format=two_digits))
        print(LEGEND)
        _print_shortest(study)
    if not study.answers:
        for sentence in belts.verdict(study):
            print(sentence)
    if study.rows:
        _print_changes(study)
    cases = f"{len(study.rows)} case{'s' * (len(study.rows) != 1)}"
    print(f"{cases} in {wall_time:.1f} s; {folder / page.PAGE}, {folder / page.RESULT}")


def _print_answers(study: belts.Study) -> None:
    """Of an own rig: the answer, then its numbers."""
    for sentence in belts.verdict(study):
        print(sentence)
    print("Lengths are rounded up to two digits.")
    rows = []
    for answer in study.answers:
        for name, question, ever in (
            (COLD, answer.run, length_text(answer.run.for_ever)),
            (STEADY, answer.interface, "-"),
        ):
            levels = [level.says if level else "-" for level in question.levels]
            rows.append((name, answer.case.speed, length_text(question.shortest), *levels, ever))
    _print_belts("shortest belt [m]", ("as said", "5 %", "median", "95 %", "for ever"), rows)


def _print_shortest(study: belts.Study) -> None:
    """The shortest belts of the nominal rig, and at the levels of its doubt."""
    print(
        "Shortest belt [m], rounded up to two digits: as the rig is given; in half and in 95 % of"
        " the sampled rigs; for ever"
    )
    doubted, rows = study.shortest_in_doubt(), []
    for case, row in {row.case.with_length(1.0): row for row in study.rows}.items():
        for name, rise, said, ever in (
            (COLD, "run", row.shortest_run, length_text(row.shortest_steady)),
            (STEADY, "interface", row.shortest_interface, "-"),
        ):
            levels = [doubted[case][rise][level].says or "-" for level in ("median", "high")]
            rows.append((name, case.speed, length_text(said), *levels, ever))
    _print_belts("question", ("as said", "median", "95 %", "for ever"), rows)


def _print_belts(what: str, headings: Sequence[str], belts: Iterable[tuple[Any, ...]]) -> None:
    """Lengths of belts by question and speed."""
    print(f"{what:<22} {'speed [m/s]':>11} " + " ".join(f"{one:>8}" for one in headings))
    for name, speed, *lengths in belts:
        print(f"{name:<22} {speed:11g} " + " ".join(f"{one:>8}" for one in lengths))


def _print_changes(study: belts.Study) -> None:
    """What would help, in the case that drifts most."""
    row = study.worst
    print(
        f"One change alone, {row.case.length:g} m at {row.case.speed:g} m/s: belt at entry,"
        " interface at constant speed, K"
    )
    for one in row.changes:
        rises = (two_digits(rise) for rise in (one.run, one.interface_drift))
        print(f"  {one.what:60} {' '.join(f'{rise:>9}' for rise in rises)}")
