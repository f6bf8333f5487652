#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Small mistakes put into the library, one at a time, and whether the tests see them.

    python3 tools/mutants.py check                every entry of tests/mutants/ still fits its file
    python3 tools/mutants.py run [--near] [--only M] [--long] [--most S] [--jobs N] [--again]
    python3 tools/mutants.py report               what build/mutants/results.txt says; fails below the limits
    python3 tools/mutants.py list                 number, name, text and what it becomes

Entries are in tests/mutants/WING.txt, WING a folder of src/:

    == src/body/stale.c: test_stale test_ledger    the file of the entries that follow, and their nearest tests
    name: test_a test_b                            the name of a mutant; its nearest tests where they are others
        if (@a < b@) return;                       the text, once in its file, what is changed between @; blanks count as one, as do breaks
        a <= b                                     what it becomes; nothing: a statement that is skipped

`name #2/3` takes the second of three such places. tests/mutants/equivalent.txt has what no test can see: `name: reason`.

All mutants are in one build: in a copy of src/ an expression e becomes (peri__mutant(17) ? (replacement) : (e)), a statement (whose text
ends with ; or }) an if with both, and the number comes from the environment variable PERI_MUTANT as the program starts. With -1 nothing
is changed, and the file PERI_REACHED gets a byte for each mutant, 1 where the program came by. So each mutant is tried by the cases alone
that come by it: those of the nearest tests first, then all others, the quickest first, until one fails. What ran is kept in
build/mutants/results.txt; where an entry or a test changes it runs again, where the library does, after `rm -r build/mutants`.
"""
import argparse
import concurrent.futures
import fcntl
import hashlib
import json
import os
import re
import resource
import shutil
import signal
import subprocess
import sys
import threading
import time

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
HOME = os.path.join(ROOT, "build", "mutants")
TREE = os.path.join(HOME, "tree")
RESULTS = os.path.join(HOME, "results.txt")
KILLED_LEAST, QUICK_LEAST = 0.95, 0.90  # of those that are not equivalent: by all tests, and by `make test` alone
# cases that measure time, which fail on a busy machine: they must fail twice, and pass in between without the mutant
TIMED = {"test_plan/measuring_builds_and_frees_a_small_body", "test_choose/laws_and_times", "test_choose/wrong_goals"}
LINKED = ["Makefile", "peri.h", "tests", "examples", "tools", "bench", "docs", "cmake", "bindings", "extras"]


MACRO = """
extern __attribute__((visibility("hidden"))) int peri__mutant_now;
extern __attribute__((visibility("hidden"))) unsigned char peri__reached[];
#define peri__mutant(number) \\
    (__builtin_expect(peri__mutant_now == (number) || (peri__mutant_now < 0 && (peri__reached[number] = 1) == 0), 0))
"""
SWITCH = """
int peri__mutant_now;
unsigned char peri__reached[%d + 1];
__attribute__((constructor)) static void peri__read_mutant(void) {
    const char *number = getenv("PERI_MUTANT");
    if (number) peri__mutant_now = atoi(number);
}
__attribute__((destructor)) static void peri__tell_reached(void) {
    const char *path = getenv("PERI_REACHED");
    FILE *file = path ? fopen(path, "wb") : NULL;
    if (file && (fwrite(peri__reached, sizeof peri__reached, 1, file) != 1 || fclose(file) != 0)) abort();
}
"""


class Mutant:
    def __init__(self, name, file, wing, tests):
        self.name, self.file, self.wing, self.tests = name, file, wing, tests
        self.number, self.which, self.places = 0, 1, 1
        self.context = self.replacement = ""

    def mark(self):
        """Of all that makes the mutant: results of another are not its own."""
        text = "|".join([self.file, self.context, self.replacement, "%d/%d" % (self.which, self.places)])
        return hashlib.sha1(text.encode()).hexdigest()[:8]


def fail(text):
    sys.exit("mutants: " + text)


def read_entries():
    folder = os.path.join(ROOT, "tests", "mutants")
    mutants, names = [], set()
    tests = os.listdir(os.path.join(ROOT, "tests"))
    answers = [file[:-2] for file in sorted(tests) if re.fullmatch(r"test_survivors\w*\.c", file)]  # near to all mutants
    for entry in sorted(os.listdir(folder)):
        if not entry.endswith(".txt") or entry == "equivalent.txt":
            continue
        file, near, mutant, lines = None, [], None, []

        def end():
            if mutant is None:
                return
            if not lines:
                fail("%s: %s has no text" % (entry, mutant.name))
            mutant.context = lines[0]
            mutant.replacement = lines[1] if len(lines) > 1 else ""
            if len(lines) > 2 or mutant.context.count("@") != 2:
                fail("%s: %s: one line with two @, one that replaces it" % (entry, mutant.name))
            mutants.append(mutant)

        with open(os.path.join(folder, entry), encoding="ascii") as stream:
            for line in stream:
                line = line.rstrip()
                if line.startswith("    "):
                    lines.append(line.strip())
                    continue
                if not line or line.startswith("#"):
                    continue
                end()
                mutant, lines = None, []
                if line.startswith("== "):
                    file, _, tests = line[3:].partition(":")
                    near = tests.split()
                    continue
                match = re.fullmatch(r"([a-z0-9_]+)( #(\d+)/(\d+))?(:(.*))?", line)
                if not match or not file:
                    fail("%s: not understood: %s" % (entry, line))
                mutant = Mutant(match[1], file, entry[:-4], ((match[6] or "").split() or near) + answers)
                if match[2]:
                    mutant.which, mutant.places = int(match[3]), int(match[4])
                if mutant.name in names:
                    fail("two mutants are called " + mutant.name)
                names.add(mutant.name)
        end()
    wings = ["kernels", "laws", "base"]  # first: what the kernels are compiled of keeps its numbers where another wing gets more
    mutants.sort(key=lambda m: (wings + [m.wing]).index(m.wing))
    for number, mutant in enumerate(mutants, 1):
        mutant.number = number
    return mutants


def read_equivalent(mutants):
    path = os.path.join(ROOT, "tests", "mutants", "equivalent.txt")
    reasons = {}
    if os.path.exists(path):
        with open(path, encoding="ascii") as stream:
            for line in stream:
                if line.strip() and not line.startswith("#"):
                    name, _, reason = line.strip().partition(": ")
                    if not reason:
                        fail("equivalent.txt: no reason: " + line.strip())
                    reasons[name] = reason
    for name in set(reasons) - {m.name for m in mutants}:
        fail("equivalent.txt: no mutant is called " + name)
    return reasons


# ---- the copy of the source

def pattern(text):
    """Blanks and breaks as any of them, a break within a macro too."""
    pieces = [re.escape(piece) for piece in re.split(r"\s+", text.strip())]
    return r"(?:\s|\\\n)+".join(pieces)


def place(mutant, text):
    """Where in its file the part between @ is; None where the text is not there as often as it should."""
    before, inside, after = mutant.context.split("@")
    blank = r"(?:\s|\\\n)*"
    parts = [pattern(before) + (blank if before.strip() else "") if before.strip() else "",
             "(" + pattern(inside) + ")",
             (blank + pattern(after)) if after.strip() else ""]
    found = list(re.finditer("".join(parts), text))
    if len(found) != mutant.places:
        return None
    return found[mutant.which - 1].span(1)


OPERATOR = "+-*/%<>=!&|^?:"
OPEN, CLOSE = "([{", ")]}"


def operators(text):
    """Does an operator of two operands stand in text, outside brackets, or at one of its ends?"""
    depth, last = 0, ""
    for at, letter in enumerate(text):
        if letter in OPEN:
            depth += 1
        elif letter in CLOSE:
            depth -= 1
        elif letter in OPERATOR and depth == 0 and (re.match(r"[\w)\]]", last) or at == 0 and letter not in "-!&*"):
            if text[at:at + 2] != "->" and text[at:at + 2] != "++" and text[at:at + 2] != "--":
                return True
        if not letter.isspace():
            last = letter if text[at - 1:at + 1] != "->" else "-"
    return False


def bounds(text, at, step):
    """Where the expression that text[at] is a part of ends, to the left (step -1) or to the right: at a bracket that is not its own, at
    , ; ? : && || and at an assignment."""
    depth, inner, outer = 0, (CLOSE if step < 0 else OPEN), (OPEN if step < 0 else CLOSE)
    while 0 <= at < len(text):
        letter, two = text[at], text[at - 1:at + 1] if step < 0 else text[at:at + 2]
        if letter in inner:
            depth += 1
        elif letter in outer:
            if depth == 0:
                break
            depth -= 1
        elif depth == 0:
            if letter in ",;?:{}" or two in ("&&", "||"):
                break
            if letter == "=" and text[at - 1] not in "<>=!" and text[at + 1] != "=":
                break
            if step > 0 and two[1:] == "=" and letter in "+-*/|&^" and text[at + 2] != "=":
                break
            if step < 0 and re.search(r"\b(return|else|case)$", text[max(0, at - 6):at + 1]):
                break
        at += step
    return at


def extend(text, begin, end):
    """The whole expression about text[begin:end], so that no operator is torn from its operands and sums keep their order. What is one
    operand, or statements, is left as it is."""
    inside = text[begin:end]
    before = text[:begin].rstrip()[-2:]
    binary = (re.match(r"[-+*/%<>=!&|^]", inside) and re.search(r"[\w)\]]$", before)
              and not re.search(r"\b(return|else)$", text[:begin].rstrip()))
    if inside.rstrip()[-1] in ";}" or not (binary or operators(inside)):
        return begin, end
    left, right = bounds(text, begin - 1, -1) + 1, bounds(text, end, 1)
    while text[left].isspace() or text[left] == "\\":
        left += 1
    while text[right - 1].isspace() or text[right - 1] == "\\":
        right -= 1
    return min(left, begin), max(right, end)


def render(text, begin, end, nodes):
    """text[begin:end] with its mutants put in; nodes: (begin, end, mutant, what the text becomes), outermost first."""
    out, at = [], begin
    while nodes:
        first = nodes[0]
        same = [n for n in nodes if n[:2] == first[:2]]
        inner = [n for n in nodes if n[:2] != first[:2] and n[0] >= first[0] and n[1] <= first[1]]
        nodes = [n for n in nodes if n not in same and n not in inner]
        for other in nodes:
            if other[0] < first[1] and other[1] > first[0]:
                fail("%s and %s overlap" % (first[2].name, other[2].name))
        made = render(text, first[0], first[1], inner)
        statement = text[first[0]:first[1]].rstrip()[-1] in ";}"
        for _, _, mutant, becomes in same:
            if statement:
                made = "if (peri__mutant(%d)) { %s } else { %s }" % (mutant.number, becomes, made)
            else:
                made = "(peri__mutant(%d) ? (%s) : (%s))" % (mutant.number, becomes, made)
        out += [text[at:first[0]], made]
        at = first[1]
    return "".join(out) + text[at:end]


def instrument(mutants):
    """{path: text} of the copy. Fails where an entry no longer fits."""
    texts, by_file, bad = {}, {}, 0
    for folder, _, files in os.walk(os.path.join(ROOT, "src")):
        for file in files:
            path = os.path.relpath(os.path.join(folder, file), ROOT)
            with open(os.path.join(ROOT, path), encoding="utf-8") as stream:
                texts[path] = stream.read()
    for mutant in mutants:
        span = place(mutant, texts[mutant.file]) if mutant.file in texts else None
        if span is None:
            print("mutants: %s does not fit %s: %s" % (mutant.name, mutant.file, mutant.context))
            bad += 1
        else:
            text = texts[mutant.file]
            whole = extend(text, *span)
            becomes = text[whole[0]:span[0]] + mutant.replacement + text[span[1]:whole[1]]
            by_file.setdefault(mutant.file, []).append((whole[0], whole[1], mutant, becomes))
    if bad:
        fail("%d entries do not fit: the source has changed, change them, too" % bad)
    for path, nodes in by_file.items():
        nodes.sort(key=lambda n: (n[0], -n[1]))
        texts[path] = render(texts[path], 0, len(texts[path]), nodes)
    texts["src/base/compiler.h"] += MACRO
    with open(os.path.join(ROOT, "peri_impl.c"), encoding="utf-8") as stream:
        texts["peri_impl.c"] = stream.read() + SWITCH % len(mutants)
    return texts


def build(mutants):
    texts = instrument(mutants)
    os.makedirs(TREE, exist_ok=True)
    for name in LINKED:
        link = os.path.join(TREE, name)
        if not os.path.lexists(link):
            os.symlink(os.path.join(ROOT, name), link)
    for path, text in texts.items():
        path = os.path.join(TREE, path)
        os.makedirs(os.path.dirname(path), exist_ok=True)
        old = None
        if os.path.exists(path):
            with open(path, encoding="utf-8") as stream:
                old = stream.read()
        if old != text:
            with open(path, "w", encoding="utf-8") as stream:
                stream.write(text)
    os.makedirs(os.path.join(TREE, "out"), exist_ok=True)
    call = ["make", "--no-print-directory", "-j2", "-s", "WERROR=-w", "CC=" + os.environ.get("CC", "cc"), "programs"]
    environment = {k: v for k, v in os.environ.items() if k not in ("MAKEFLAGS", "MAKELEVEL", "MFLAGS", "PERI_MUTANT")}
    if subprocess.run(call, cwd=TREE, env=environment).returncode != 0:
        fail("the copy does not compile")


# ---- cases

class Case:
    """What is run at once: a case of a test program, a subject of the extremes, an example."""

    def __init__(self, name, source, command):
        self.name, self.source, self.command = name, source, command
        self.program = name.partition("/")[0]
        self.seconds, self.reached = 0.0, set()


def all_cases():
    """Of what `make test` runs and a mutant can change."""
    found = []
    for file in sorted(os.listdir(os.path.join(ROOT, "tests"))):
        if not re.fullmatch(r"test_\w+\.c", file):
            continue
        with open(os.path.join(ROOT, "tests", file), encoding="utf-8") as stream:
            names = re.findall(r"\bRUN\((\w+)\)", stream.read())
        program = "build/tests/" + file[:-2]
        found += [Case(file[:-2] + "/" + name, "tests/" + file, [program, name]) for name in names]
        if not names:
            found.append(Case(file[:-2] + "/", "tests/" + file, [program]))
    subjects = set()
    for file in sorted(os.listdir(os.path.join(ROOT, "tests", "extremes"))):
        with open(os.path.join(ROOT, "tests", "extremes", file), encoding="utf-8") as stream:
            subjects.update(re.findall(r'EXTREME_TABLE\("(\w+)"', stream.read()))
    for subject in sorted(subjects):
        found.append(Case("extremes/" + subject, "tests/extremes", ["build/tests/extremes", "--some", subject]))
    for file in sorted(os.listdir(os.path.join(ROOT, "examples"))):
        if file.endswith(".c"):
            found.append(Case("example_%s/" % file[:-2], "examples/" + file, ["build/examples/" + file[:-2]]))
    return found


FINGERPRINTS = {}


def fingerprint(source):
    if source not in FINGERPRINTS:
        path = os.path.join(ROOT, source)
        files = sorted(os.path.join(path, f) for f in os.listdir(path)) if os.path.isdir(path) else [path]
        digest = hashlib.sha1()
        for file in files:
            with open(file, "rb") as stream:
                digest.update(stream.read())
        FINGERPRINTS[source] = digest.hexdigest()[:8]
    return FINGERPRINTS[source]


def processor_seconds(process):
    try:
        with open("/proc/%d/stat" % process, encoding="ascii") as stream:
            part = stream.read().rpartition(")")[2].split()
        return (int(part[11]) + int(part[12])) / os.sysconf("SC_CLK_TCK")
    except OSError:
        return 0.0  # no /proc: the clock ends it


class Room:
    """Folders where programs run, one for each that runs at a time: some write files."""

    def __init__(self, jobs):
        self.lock, self.free, self.held, worker = threading.Lock(), [], [], 0
        while len(self.free) < jobs:
            folder = os.path.join(HOME, "run%d" % worker)
            worker += 1
            os.makedirs(os.path.join(folder, "out"), exist_ok=True)
            held = open(os.path.join(folder, "lock"), "w")
            try:
                fcntl.flock(held, fcntl.LOCK_EX | fcntl.LOCK_NB)
            except OSError:  # another run of this tool is there
                continue
            self.held.append(held)
            for name in LINKED + ["src", "peri_impl.c", "build"]:
                if not os.path.lexists(os.path.join(folder, name)):
                    os.symlink(os.path.join(TREE, name), os.path.join(folder, name))
            self.free.append(folder)

    def attempt(self, command, number, limit, reached=None):
        """(ended as it should, seconds of the processors) of one run; they are limited, not those of the clock, for the machine may be
        busy. It is ended at the first case that failed."""
        with self.lock:
            folder = self.free.pop()
        environment = dict(os.environ, OMP_WAIT_POLICY="passive", PERI_MUTANT=str(number))
        if reached:
            environment["PERI_REACHED"] = reached

        def limits():
            resource.setrlimit(resource.RLIMIT_AS, (16 << 30, 16 << 30))
            resource.setrlimit(resource.RLIMIT_CORE, (0, 0))

        process = subprocess.Popen(command, cwd=folder, env=environment, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL,
                                   preexec_fn=limits)
        ended = threading.Event()

        def watch():  # not by RLIMIT_CPU, under which some machines tell the seconds of processors in coarse ticks
            began = time.time()
            while not ended.wait(1.0):
                if processor_seconds(process.pid) > limit or time.time() - began > 20 * limit + 60:
                    os.kill(process.pid, signal.SIGKILL)

        watcher = threading.Thread(target=watch)
        watcher.start()
        failed = False
        for line in process.stdout:
            if line.startswith(b"  FAIL"):
                failed = True
                os.kill(process.pid, signal.SIGKILL)  # which does not reap it, as process.kill may
                break
        process.stdout.close()
        _, status, usage = os.wait4(process.pid, 0)
        process.returncode = status
        ended.set()
        watcher.join()
        with self.lock:
            self.free.append(folder)
        return status == 0 and not failed, usage.ru_utime + usage.ru_stime


def measure(cases, mutants, room, jobs):
    """Seconds of every case without a mutant, where it must pass, and the mutants that it comes by. What is known is kept; a mutant that is
    newer counts as one that all come by."""
    path, names = os.path.join(HOME, "reached.json"), [m.name for m in mutants]
    known = {"lists": [], "cases": {}}
    if os.path.exists(path):
        with open(path, encoding="ascii") as stream:
            known = json.load(stream)
    if names not in known["lists"]:
        known["lists"].append(names)
    at = known["lists"].index(names)
    lock, bad = threading.Lock(), []

    def one(case):
        file = os.path.join(HOME, "reached_%s" % case.name.replace("/", "."))
        ok, took = room.attempt(case.command, -1, 900, file)
        if not ok and case.name in TIMED:
            ok, took = room.attempt(case.command, -1, 900, file)
        with lock:
            if not ok and case.name in TIMED:
                print("mutants: %s fails without a mutant: left out on this busy machine" % case.name)
                return
            if not ok:
                bad.append(case.name)
                return
            with open(file, "rb") as stream:
                marks = stream.read()
            os.remove(file)
            reached = "".join(str(marks[number]) for number in range(1, len(names) + 1))
            known["cases"][case.name] = [fingerprint(case.source), took, at, "%x" % int("1" + reached, 2)]
            with open(path + ".new", "w", encoding="ascii") as stream:
                json.dump(known, stream)
            os.replace(path + ".new", path)

    todo = [c for c in cases if c.name not in known["cases"] or known["cases"][c.name][0] != fingerprint(c.source)]
    with concurrent.futures.ThreadPoolExecutor(jobs) as pool:
        list(pool.map(one, todo))
    if bad:
        fail("without a mutant these fail: " + " ".join(sorted(bad)))
    for case in [c for c in cases if c.name in known["cases"]]:
        _, case.seconds, of, bits = known["cases"][case.name]
        then, marks = known["lists"][of], bin(int(bits, 16))[3:]
        case.reached = {name for name, mark in zip(then, marks) if mark == "1"} | (set(names) - set(then))


# ---- results: a line per run: name, mark, case, fingerprint of the test, what came of it, seconds

def read_results(mutants):
    """{name: {case: (fingerprint, outcome)}} of the mutants as they are."""
    marks, found = {m.name: m.mark() for m in mutants}, {}
    if os.path.exists(RESULTS):
        with open(RESULTS, encoding="ascii") as stream:
            for line in stream:
                part = line.split()
                if len(part) == 6 and marks.get(part[0]) == part[1]:
                    found.setdefault(part[0], {})[part[2]] = (part[3], part[4])
    return found


def killer(results):
    for case, (_, outcome) in results.items():
        if outcome == "killed":
            return case
    return None


def chosen(mutants, only):
    first, _, last = only.partition("-")
    if first.isdigit():
        return [m for m in mutants if int(first) <= m.number <= int(last or first)]
    return [m for m in mutants if m.wing == only or re.search(only, m.name)]


def forget(names):
    if os.path.exists(RESULTS):
        with open(RESULTS, encoding="ascii") as stream:
            kept = [line for line in stream if line.split()[0] not in names]
        with open(RESULTS, "w", encoding="ascii") as stream:
            stream.writelines(kept)


def run(options, mutants):
    equivalent = read_equivalent(mutants)
    build(mutants)
    room, cases = Room(options.jobs), all_cases()
    programs = {c.program for c in cases}
    for mutant in mutants:
        for test in mutant.tests:
            if test not in programs:
                fail("%s: no test program %s" % (mutant.name, test))
    wanted = [m for m in chosen(mutants, options.only) if m.name not in equivalent]
    if options.near:
        nearest = {test for mutant in wanted for test in mutant.tests}
        cases = [c for c in cases if c.program in nearest]
    measure(cases, mutants, room, options.jobs)
    if options.again:
        forget({m.name for m in wanted})
    results, lock, began = read_results(mutants), threading.Lock(), time.time()

    def keep(mutant, name, stamp, ok, took):
        with lock:
            results.setdefault(mutant.name, {})[name] = (stamp, "passed" if ok else "killed")
            with open(RESULTS, "a", encoding="ascii") as stream:
                stream.write("%s %s %s %s %s %.2f\n" % (mutant.name, mutant.mark(), name, stamp, "passed" if ok else "killed", took))

    def attempt(mutant, case, more):
        limit = 3600 if more else 10 * case.seconds + 5
        ok, took = room.attempt(case.command + more, mutant.number, limit)
        if not ok and case.name in TIMED:
            ok = not room.attempt(case.command, 0, limit)[0] or room.attempt(case.command, mutant.number, limit)[0]
        return ok, took

    def one(mutant):
        mine = results.setdefault(mutant.name, {})
        order = sorted((c for c in cases if mutant.name in c.reached), key=lambda c: (c.program not in mutant.tests, c.seconds))
        if options.near:
            order = [c for c in order if c.program in mutant.tests]
        if options.most:
            order = [c for c in order if c.seconds <= options.most]
        steps = [(c, c.name, []) for c in order]
        if options.long:
            steps += [(c, c.program + "/--long", ["--long"]) for c in {c.program: c for c in order if "/test_" in c.source}.values()]
        for case, name, more in steps:
            if killer(mine):
                break
            if name not in mine or mine[name][0] != fingerprint(case.source):
                keep(mutant, name, fingerprint(case.source), *attempt(mutant, case, more))
        if not steps:
            keep(mutant, "none", "-", True, 0.0)
        print("%4d %-8s %s %s" % (mutant.number, "killed" if killer(mine) else "SURVIVED", mutant.name, killer(mine) or ""), flush=True)

    with concurrent.futures.ThreadPoolExecutor(options.jobs) as pool:
        list(pool.map(one, [m for m in wanted if not killer(results.get(m.name, {}))]))
    print("%.0f s" % (time.time() - began))
    return report(mutants)


def report(mutants):
    results, equivalent = read_results(mutants), read_equivalent(mutants)
    table, survivors, untried, wrong = {}, [], [], []
    quick = killed = counted = near = 0
    for mutant in mutants:
        row = table.setdefault(mutant.wing, [0, 0, 0, 0, 0])
        row[0] += 1
        by = killer(results.get(mutant.name, {}))
        if mutant.name in equivalent:
            row[4] += 1
            if by:
                wrong.append("%s is called equivalent, and %s kills it" % (mutant.name, by))
            continue
        counted += 1
        if by:
            row[1] += 1
            killed += 1
            quick += not by.endswith("--long")
            near += by.partition("/")[0] in mutant.tests
            row[3] += by.partition("/")[0] in mutant.tests
        elif mutant.name in results:
            row[2] += 1
            survivors.append(mutant)
        else:
            untried.append(mutant)
    print("%-10s %7s %7s %9s %9s %11s" % ("wing", "mutants", "killed", "by near", "survived", "equivalent"))
    for wing in sorted(table):
        row = table[wing]
        print("%-10s %7d %7d %9d %9d %11d" % (wing, row[0], row[1], row[3], row[2], row[4]))
    for mutant in survivors:
        print("survived %d %s: %s: %s" % (mutant.number, mutant.name, mutant.file, mutant.context))
    for text in wrong:
        print("mutants: " + text)
    if untried:
        print("%d were not tried" % len(untried))
    print("%d mutants, %d equivalent; of the others %d killed (%.1f %%), %d by make test alone (%.1f %%), %d by the nearest tests"
          % (len(mutants), len(equivalent), killed, 100.0 * killed / max(counted, 1), quick, 100.0 * quick / max(counted, 1), near))
    tried = counted - len(untried)
    return 1 if wrong or not tried or killed < KILLED_LEAST * tried or quick < QUICK_LEAST * tried else 0


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("what", choices=["check", "build", "run", "report", "list"])
    parser.add_argument("--near", action="store_true", help="the nearest tests alone")
    parser.add_argument("--only", default="", help="17, 100-150, a wing, or a part of names")
    parser.add_argument("--long", action="store_true", help="survivors with --long, too")
    parser.add_argument("--most", type=float, default=0.0, help="leave out, beside the nearest, programs that take more seconds")
    parser.add_argument("--jobs", type=int, default=2)
    parser.add_argument("--again", action="store_true", help="forget what is known")
    options = parser.parse_args()
    if options.what == "run" and not shutil.which("make"):
        fail("no make")
    mutants = read_entries()
    if options.what == "check":
        instrument(mutants)
        read_equivalent(mutants)
        print("mutants: %d entries fit" % len(mutants))
        return 0
    if options.what == "list":
        for mutant in mutants:
            print("%d %s %s: %s -> %s" % (mutant.number, mutant.name, mutant.file, mutant.context, mutant.replacement or "nothing"))
        return 0
    if options.what == "build":
        build(mutants)
        return 0
    return run(options, mutants) if options.what == "run" else report(mutants)


if __name__ == "__main__":
    sys.exit(main())
