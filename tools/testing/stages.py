# SPDX-License-Identifier: MIT
"""What each stage of `dev.py test` does; each returns how many tests passed, failed and were skipped."""

from __future__ import annotations

import os
import re
import shlex
import time
from collections.abc import Mapping, Sequence
from concurrent.futures import ThreadPoolExecutor
from enum import Enum
from fnmatch import fnmatchcase
from pathlib import Path

from tools.packaging import compiling, packages
from tools.packaging.compiling import compile_preset, installed_core
from tools.paths import LOGS, TOP
from tools.platforms import LINUX, TESTED_PLATFORMS, WINDOWS, Platform
from tools.setup import blender, environments, machine, windows
from tools.setup.environments import BPY_PYTHON, HOST
from tools.shell import Failure, run, say
from tools.testing import engines as engine_tests
from tools.testing import fuzzing, style
from tools.testing.counts import Counts, read_report

_BLENDER_TESTS = TOP / "tests" / "blender"
_NOT_THOROUGH = ("-m", "not measures and not thorough")
# Install, register, import, build, drive, bake: whether the add-on runs. All of its tests run in Linux's Blenders.
_SHORT = (
    "blender/test_register.py",
    "blender/test_extension_life.py",
    "blender/test_sample.py",
    "blender/mocap/test_importing.py",
    "blender/drive/test_drive.py",
    "blender/bake/test_baking.py",
)
# What Windows does otherwise than Linux: its files, their names, paths and locks.
_FILES = (
    "blender/bake/test_exporting.py",
    "blender/character/test_storing.py",
    "blender/mocap",
    "blender/strangers/test_strangers_policies.py",
    "blender/test_command_line.py",
    "blender/test_files_that_last.py",
    "blender/test_trace_files.py",
    "blender/test_what_is_reopened.py",
)
# The same of the binding: the core's bits are compared with those of Linux besides.
_BINDING_FILES = tuple(
    f"python/test_{name}.py"
    for name in ("arrays", "bvh", "crowd", "errors", "names", "policy_files", "progress", "threads", "wrong_arguments")
)
_THREADED_TESTS = "Thread|ParallelFor|Crowd"
# Whole characters made again and again for their figures, an hour's takes: what these call, others call as well.
# Neither under sanitizers nor among the quick ones.
_THOROUGH = (
    "ApiMakeWay.KeepsTwoHundredOnASquareApart",
    "ApiMakeWay.LetsNobodyTouchWhereAHundredGoThroughOnePlace",
    "Build.GivesTheSameBitsForAnyNumberOfThreads",
    "Build.GivesTheSameBitsWhereASkeletonHasOneLeg",
    "Build.HasClassesForHopsOnTheSpotAndAhead",
    "Build.IsCancelledAtEveryReport",
    "Build.IsTheSameCharacterTenTimesAsLarge",
    "Build.MirrorsAndSynthesizesOnlyWhenAsked",
    "Build.NamesItsPolicyAndFillsTheTableWithClasses",
    "Build.RepairsItsTablesForGood",
    "Build.TellsItsProgressInOrder",
    "Build.TheFirstPolicyAskedForDrives",
    "Bvh.BandaiNamcoStandsUprightOnTheGround",
    "Bvh.TakesMemoryInProportionToTheFile",
    "ChangePushes.*",
    "Clearance.IsNextToWhatIsWantedOrOffByTheLeast",
    "Cluster.LeavesNoClassEmptyHoweverFewTheIterations",
    "Cluster.OfManyFragments*",
    "Crowd.ShowsTheSameBitsWhateverTheThreads",
    "Doctor.FindsAndFillsSpikes",
    "Doctor.FindsNothingInCleanMotion",
    "Doctor.LosesNothingWhereThePiecesOfALongTakeMeet",
    "Doctor.PutsRightAnyUnit",
    "FragmentSelector.Leaves*",
    "GroundFollower.AsksForTheGroundAtMostEightTimesAStep",
    "GroundFollower.GoesTheSameWayOnTheSlopeAndIsTheSameEveryTime",
    "GroundFollower.ShowsOnLevelGroundToTheBitWhatIsShownWithoutGround",
    "KeepClear.KeepsTwoHundredOnASquareApart",
    "KeepClear.LeavesNoAreaAndComesBackToIt",
    "MakeWay.LetsNobodyTouchAnotherWhoDoesAsIsSaid",
    "Mirror.ReflectsRealTakesWithinTheBonesAsymmetry",
    "MotionMetrics.FindsLessSkateWhereFeetAreLocked",
    "OptimalPerformance.IsNeverReachedByAPlayer",
    "OwnControls.AreSaidToBeHeldOrNot",
    "OwnControls.AreTheChangesThatAreTimed",
    "OwnControls.AreWhatEverythingAsksFor",
    "OwnControls.ComeBackFromAFile",
    "OwnControls.ReplayWhatWasRecordedWithOthers",
    "PackedClip.KeepsAllTakesInLessThanAnEighthOfTheirSize",
    "Path.FindsTheNearestPlaceAsBruteForceDoes",
    "Pin.Is*",
    "Player.LosesNoJumpHoweverShortlyItIsPressed",
    "Player.NeverJumps",
    "Player.ResponsivenessIsPaidForWithWorseStitches",
    "PlayerStyles.BeginWithinTheirTimeToWait",
    "PlayerStyles.ChangeAsSmoothlyAsOtherStitches",
    "PolicyFile.TakesFragmentsOfTwentyMilliseconds",
    "PolicyFile.TakesNoMemoryOutOfProportionToItsSize",
    "ResponseTimes.*",
    "Retarget.FeetAndKneesKeepTheirMannersOnOtherProportions",
    "Retarget.HowTheArmsAreHeldAtRestDoesNotMatter",
    "Styles.AreInThePolicyFile",
    "Styles.AreWhatABuildMakesOfTheirTakesAlone",
    "SuggestClasses.*",
    "Synthesize.IsDeterministic",
    "WithoutClasses.NeverPlaysAnExcludedOneNotEvenStanding",
)
# Whole characters and long play, which read nothing that somebody else has written: what they call, the other sanitized
# tests call as well. CI leaves them out.
_NOT_SANITIZED = (
    "ApiMakeWay.*",
    "ApiPlayer.GoesTheSameWayAtAnyFrameRateByFixedSteps",
    "ApiState.AsksForTheGround*",
    "ApiState.GoesBackToTheBitOnHills*",
    "Build.BuildsAtTheEndsOfTheRangesWhatCanBeSaved",
    "Build.FindsTheGaitsOfItsTakes",
    "Build.HasNoMoreClassesThanDistinctFragments",
    "Build.HoldsWhatItsReportSays",
    "Build.IsTheSameCharacterOfATakeThatWasCapturedHigher",
    "Build.IsTheSameCharacterOfAWalkThatWasCapturedOnAFloorThatRises",
    "Build.LearnsFromATraceOfOneControl",
    "Build.MakesOneClass",
    "Build.RefusesOptionsOutOfTheirRangesBeforeItBegins",
    "Build.RunsOnTheOneStepOfARunThatItsTakesHold",
    "Build.StandsWhereTheTakesCanDoNothingElse",
    "Build.TakesARigWithoutKneesAndLocksNoFeet",
    "Crowd.ShowsWhatPlayersShowThatAreSteppedAlone",
    "Doctor.IsStoppedInTheMiddleOfATakeOnAnyThread",
    "Doctor.LeadsByItsFeetWhatGoesInPlace",
    "Doctor.TellsByFallsThatTheRateIsAnother",
    "Doctor.TellsFeetThatHoverOverWhereTheyAreAtRest",
    "Explainer.*",
    "FeetWay.*",
    "FragmentSelector.GoesOnWithNoClassThatIsLeftOut",
    "GaitHeights.AreThoseOfWhatIsMade",
    "GroundFollower.GoesOnGroundThatIsLevelButForRoundingAsWithoutGround",
    "GroundFollower.GoesTheSameInEverySizeOnStairsOfThatSize",
    "GroundFollower.IsLiftedOnAHigherLevelAndOtherwiseTheSame",
    "GroundFollower.LiftsNoFootOverTheHipsForAWallThatReachesToTheKnees",
    "GroundFollower.LooksTheSameOnASlopeThatIsTurnedWithTheCharacter",
    "GroundFollower.ShowsPosesOnGroundThatIsNoise",
    "GroundFollower.StaysWithinABodysReachOfTheGroundItIsOver",
    "GroundFollower.TellsHowLongThereWasNoGroundAndKeepsItsHeight",
    "GroundFollower.WhipsNoLegAboutItsHipOnStairs",
    "HeldGaits.ArePlayedWhereAControlIsHeld",
    "IteratePolicy.EndsHoweverFarTheValues",
    "JointLimits.FindNoFaultInTheTakesAndSeeAKneeBentBackward",
    "LookStitch.TakesLongestWhereTheBodyItselfIsTurnedAsFast",
    "Player.NeverHopsUnasked",
    "Player.StaysInATakeTheMoreTheMoreItCostsToLeaveIt",
    "Player.WalksOnLegsWhoseToeIsNoneOfTheirs",
    "PlayerConstants.ChangeWhatFeetAndLeanShow",
    "PlayerMoves.BeginWithinTheirTimeToWaitAndLastTheirLength",
    "Retarget.FeetOfNoKnownLengthAreTakenForUsualOnes",
    "Retarget.LegsWithoutFeetStandOnTheirShins",
    "Retarget.ThereAndBackAgainIsTheSame",
    "Retarget.ThreadsChangeNoBit",
    "SpeedRipples.AreOfASpeedEachBesideTheTakes",
    "Styles.LeaveOutClassesOfTheirOwn",
    "Styles.StayWhenMovesAndClassesChange",
    "Styles.ThatCannotBeBuiltAreNamed",
    "Successors.OfGaitsAndStandsThatWereMadeComeRoundAgain",
    "Synthesize.*",
    "WithoutClasses.*",
)
_TESTED = ("fragmotion_tests", "fragmotion_runtime_tests")  # and benchmarks besides, which the rest compiles
_MAKERS = "*.DISABLED_*"  # of files that tests read
_FUZZ_RUNS = 5000  # of each fuzzer: a minute together


class Skipped(Exception):
    """Why a stage cannot run on this machine."""


class Part(Enum):
    """Which tests of a stage run."""

    ALL = "all"
    QUICK = "quick"
    REST = "rest"


_MARKS = {Part.QUICK: "not thorough", Part.REST: "thorough and not bpy"}  # of pytest; the markers are in pyproject.toml


def style_checks(expression: str | None) -> Counts:
    """How the code is written; `expression` selects nothing."""
    passed, failures = style.check()
    for failure in failures:
        say(failure)
    return Counts(passed, len(failures))


def tidy(expression: str | None) -> Counts:
    """What clang-tidy finds in the core; `expression` selects nothing."""
    passed, failures = style.tidy()
    for failure in failures:
        say(failure)
    return Counts(passed, len(failures))


def cpp(expression: str | None, part: Part = Part.ALL) -> Counts:
    """GoogleTest, and through ctest what games link; `expression` is a regular expression here."""
    targets = _TESTED if part is Part.QUICK else ()
    folder = compile_preset("release", *targets)
    if part is Part.REST:
        return _googletest("cpp", folder, expression, wanted=_THOROUGH)
    left_out = _THOROUGH if part is Part.QUICK else ()
    return _googletest("cpp", folder, expression, left_out) + _runtime_alone(folder, expression)


def _runtime_alone(folder: Path, expression: str | None) -> Counts:
    selection = ["--tests-regex", expression] if expression else []
    report = _fresh_report("cpp-runtime")
    options = ["--output-on-failure", "--output-junit", str(report), "--label-regex", "runtime"]
    return _counted(["ctest", "--test-dir", folder, *options, *selection], "cpp-runtime", {}, expression)


def sanitize(expression: str | None, part: Part = Part.ALL) -> Counts:
    """The tests of cpp under the address and undefined-behaviour sanitizers; `expression` as there."""
    left_out = (*_THOROUGH, *_NOT_SANITIZED) if part is Part.REST else _THOROUGH
    return _googletest("sanitize", compile_preset("sanitize", "fragmotion_tests"), expression, left_out)


def threads(expression: str | None) -> Counts:
    """The tests that start threads, under the thread sanitizer; `expression` as in cpp."""
    folder = compile_preset("thread", "fragmotion_tests")
    return _googletest("threads", folder, expression or _THREADED_TESTS)


def fuzz(expression: str | None) -> Counts:
    """The fuzzers, the same inputs every time; `expression` is a part of their names."""
    names = [name for name in fuzzing.names() if (expression or "") in name]
    result = fuzzing.fuzz_alike(_FUZZ_RUNS, names)
    return Counts(len(names) - len(result.findings), len(result.findings))


def python(expression: str | None, part: Part = Part.ALL) -> Counts:
    """The binding's tests, with the core that this machine's compiler builds for the Python that runs this."""
    core = {"PYTHONPATH": str(installed_core(HOST, packages.wheel(HOST)))}
    return _pytest("python", HOST, TOP / "tests" / "python", core, expression, _marked(part))


def game(expression: str | None) -> Counts:
    """libfragmotion as games get it: installed, found, and linked by games of any standard."""
    return _pytest("game", HOST, TOP / "tests" / "game", {}, expression)


def same_bits(expression: str | None) -> Counts:
    """Ten wild minutes, compiled for several machines and run as on them, and in the add-on's core: the same bits."""
    return _pytest("same-bits", HOST, TOP / "tests" / "same_bits", {"PYTHONPATH": str(TOP)}, expression)


def engines(expression: str | None) -> Counts:
    """A character in each engine that Debian unstable has here."""
    absent = engine_tests.absent()
    tests = sorted(engine_tests.TESTS.glob("test_*.py"))
    wanted = [path for path in tests if path.stem.removeprefix("test_") not in absent]
    counts = engine_tests.skipped(absent)
    return counts + _pytest("engines", HOST, wanted, engine_tests.environment(), expression) if wanted else counts


def package(expression: str | None) -> Counts:
    """Build the zips for the platforms that the next stages run them on, and look into them."""
    return packages_of(TESTED_PLATFORMS, expression)


def packages_of(platforms: tuple[Platform, ...], expression: str | None = None) -> Counts:
    """Build the zips of platforms, and look into them."""
    for platform in platforms:
        _say_packages(platform)
    environment = {
        "PYTHONPATH": str(TOP),
        "FRAGMOTION_PLATFORMS": " ".join(platform.name for platform in platforms),
        "FRAGMOTION_MORE_PYTHONS": " ".join(platforms[0].more_pythons),
    }
    return _pytest("package", HOST, TOP / "tests" / "packages", environment, expression)


def _say_packages(platform: Platform) -> None:
    """Build a platform's zips and say where they are, how big, and which Pythons they are for."""
    say(f"build: the zips for {platform.name}")
    start = time.monotonic()
    for path in packages.build(platform):
        size, pythons = path.stat().st_size / 1e6, ", ".join(packages.pythons_inside(path))
        say(f"{path.relative_to(TOP)}: {size:.1f} MB, for Python {pythons}, after {time.monotonic() - start:.0f} s")


def blender_45(expression: str | None) -> Counts:
    """All of the add-on's tests in Blender 4.5 LTS, a Python 3.11 module."""
    return _pytest("blender-4.5", "3.11", _BLENDER_TESTS, _extension("blender-4.5"), expression)


def blender_52(expression: str | None) -> Counts:
    """The quick ones of the add-on's tests in Blender 5.2 LTS, a Python 3.13 module."""
    return _pytest("blender-5.2", "3.13", _BLENDER_TESTS, _extension("blender-5.2"), expression, _NOT_THOROUGH)


def blender_debian(expression: str | None, part: Part = Part.ALL) -> Counts:
    """The add-on's tests in Debian's Blender (3.4.1 on Debian 12, 4.3 on 13), with pytest inside it; the quick ones are
    whether it runs."""
    is_quick = part is Part.QUICK
    tests = [TOP / "tests" / name for name in _SHORT] if is_quick else [_BLENDER_TESTS]
    options = _NOT_THOROUGH if is_quick else ("-m", "not measures")
    arguments = [machine.PYTEST_FOLDER, *_pytest_arguments("blender-debian", expression, *tests, *options)]
    command = blender.background_command(_BLENDER_TESTS / "run_in_blender.py", *arguments)
    return _counted(command, "blender-debian", _debian("blender-debian", part), expression)


def _marked(part: Part) -> tuple[str, ...]:
    """pytest's options for a part of the tests."""
    return ("-m", _MARKS[part]) if part in _MARKS else ()


def windows_python(expression: str | None) -> Counts:
    """The binding's tests of what Windows does otherwise, by Wine, and whether its core makes what Linux's makes."""
    core = compiling.unpacked_core(packages.wheels_for(WINDOWS)[BPY_PYTHON], WINDOWS)
    path = windows.path(core)
    tests = _windows("windows", BPY_PYTHON, _BINDING_FILES, {"PYTHONPATH": path}, expression)
    return tests + _same_bits(path, expression)


def _same_bits(windows_path: str, expression: str | None) -> Counts:
    core = compiling.unpacked_core(packages.wheels_for(LINUX)[BPY_PYTHON], LINUX)
    environment = {
        **windows.environment("windows"),
        "PYTHONPATH": os.pathsep.join((str(core), str(TOP / "tests" / "python"))),
        "FRAGMOTION_WINDOWS_PYTHON": shlex.join(str(word) for word in windows.python_command(BPY_PYTHON)),
        "FRAGMOTION_WINDOWS_PATH": windows_path,
    }
    return _pytest("windows-bits", BPY_PYTHON, TOP / "tests" / "windows", environment, expression)


def windows_45(expression: str | None) -> Counts:
    """The add-on's tests of what Windows does otherwise in its Blender 4.5, by Wine."""
    return _windows_blender("windows-4.5", "3.11", [*_SHORT, *_FILES], expression)


def windows_52(expression: str | None) -> Counts:
    """Some of the add-on's tests in Windows' Blender 5.2, by Wine."""
    return _windows_blender("windows-5.2", "3.13", _SHORT, expression)


def _windows_blender(stage: str, version: str, tests: Sequence[str], expression: str | None) -> Counts:
    folders = {name: windows.path(folder) for name, folder in blender.sandbox(stage).items()}
    addon = windows.path(packages.extension_path(WINDOWS))
    return _windows(stage, version, tests, {**folders, "FRAGMOTION_ADDON_ZIP": addon}, expression)


def _windows(
    stage: str, version: str, tests: Sequence[str], environment: Mapping[str, str], expression: str | None
) -> Counts:
    folders = [TOP / "tests" / name for name in tests]
    command = [
        *windows.python_command(version),
        "-m",
        "pytest",
        *_pytest_arguments(stage, expression, *_NOT_THOROUGH, *folders),
    ]
    return _counted(command, stage, {**windows.environment(stage), **environment}, expression)


def gui(expression: str | None, part: Part = Part.ALL) -> Counts:
    """Window tests: pytest on a screen of its own; the tests start Blender's windows themselves."""
    if not gui_tests():
        raise Skipped("tests/gui holds no test yet")
    environment = {**_debian("gui", part), "LIBGL_ALWAYS_SOFTWARE": "1"}
    screen = ("xvfb-run", "--auto-servernum", "--server-args", "-screen 0 1600x900x24")
    arguments = _pytest_arguments("gui", expression, TOP / "tests" / "gui")
    command = [*screen, environments.environment_python(HOST), "-m", "pytest", *arguments]
    return _counted(command, "gui", environment, expression)


def gui_tests() -> list[Path]:
    """The window tests there are."""
    return list((TOP / "tests" / "gui").glob("test_*.py"))


def _googletest(
    stage: str, folder: Path, expression: str | None, left_out: tuple[str, ...] = (), wanted: tuple[str, ...] = ("*",)
) -> Counts:
    """The C++ tests in one process a processor, since they take long to build the characters that they share."""
    program = folder / "fragmotion_tests"
    if expression:
        matching = _tests_that_match(program, expression)
        wanted = tuple(name for name in matching if any(fnmatchcase(name, pattern) for pattern in wanted)) or ("none",)
    selection = f"--gtest_filter={':'.join(wanted)}-{':'.join((*left_out, _MAKERS))}"
    shards = os.cpu_count() or 1

    def run_shard(shard: int) -> Counts:
        name = f"{stage}-{shard}"
        options = ["--gtest_brief=1", f"--gtest_output=xml:{_fresh_report(name)}", selection]
        environment = {"GTEST_TOTAL_SHARDS": str(shards), "GTEST_SHARD_INDEX": str(shard)}
        return _counted([program, *options], name, environment, expression)

    with ThreadPoolExecutor(shards) as pool:
        return sum(pool.map(run_shard, range(shards)), Counts())


def _tests_that_match(program: Path, expression: str) -> list[str]:
    lines: list[str] = []
    run([program, "--gtest_list_tests"], "cpp-names", hear=lines.append, timeout=60.0)
    suite, names = "", []
    for line in lines:
        word = line.split("#")[0].strip()
        if line.startswith(" "):
            names.append(suite + word)
        else:
            suite = word
    return [name for name in names if re.search(expression, name)]


def _extension(sandbox: str) -> dict[str, str]:
    return {**blender.sandbox(sandbox), "FRAGMOTION_ADDON_ZIP": str(packages.extension_path(LINUX))}


def _debian(sandbox: str, part: Part) -> dict[str, str]:
    """What Debian's Blender is told; its zip has a core that this machine's compiler built where not all runs."""
    package = packages.debian_zip() if part is Part.ALL else packages.build_for_debian()
    return {**blender.debian_environment(sandbox), "FRAGMOTION_ADDON_ZIP": str(package)}


def _pytest(
    stage: str,
    version: str,
    tests: Path | Sequence[Path],
    environment: Mapping[str, str],
    expression: str | None,
    options: Sequence[str] = (),
) -> Counts:
    folders = [tests] if isinstance(tests, Path) else tests
    arguments = _pytest_arguments(stage, expression, *options, *folders)
    command = [environments.environment_python(version), "-m", "pytest", *arguments]
    return _counted(command, stage, environment, expression)


def _pytest_arguments(stage: str, expression: str | None, *tests: str | Path) -> list[str | Path]:
    selection = ["-k", expression] if expression else []
    return ["-q", f"--junitxml={_fresh_report(stage)}", *selection, *tests]


def _fresh_report(stage: str) -> Path:
    report = LOGS / f"{stage}.xml"
    report.unlink(missing_ok=True)
    return report


def _counted(command: list[str | Path], stage: str, environment: Mapping[str, str], expression: str | None) -> Counts:
    """Run a test program and count by its JUnit report; it must have run a test, unless a selection left none."""
    failure = None
    try:
        run(command, stage, environment, echo=True)
    except Failure as raised:
        failure = raised
    report = LOGS / f"{stage}.xml"
    counts = read_report(report)
    left_none = expression and report.exists() and counts == Counts()
    if failure and not counts.failed and not left_none:
        raise failure
    if counts.passed + counts.failed == 0 and not expression:
        raise Failure("no test ran")
    return counts
