"""Runs Catch2 test cases as CTest does, each in a process of its own, until the time is over."""

import concurrent.futures
import os
import subprocess
import time

LONGEST = 600  # s for one test case


def environment(build, folder, program=None):
    """Coefficients of hulls are kept with the build that computed them; sanitizers end the process at what they find."""
    result = dict(os.environ)
    result["STILLHOOK_CACHE"] = str(folder / "coefficients")
    result["OMP_WAIT_POLICY"] = "passive"  # as under CTest
    result["ASAN_OPTIONS"] = "detect_leaks=1:strict_string_checks=1"
    result["UBSAN_OPTIONS"] = "print_stacktrace=1"
    result["TSAN_OPTIONS"] = "halt_on_error=1:second_deadlock_stack=1"
    if program and program.exists():
        result["STILLHOOK_TEST_PROGRAM"] = str(program)
    return result


def names_of(program, specification):
    # Catch2 ends with the number of the tests that it lists.
    arguments = [str(program), "--list-test-names-only", "-#", specification]
    listed = subprocess.run(arguments, capture_output=True, text=True, env=environment(program.parent, program.parent))
    return [line for line in listed.stdout.splitlines() if line.strip()]


def run_one(program, name, end, env):
    """(name, None or what failed, seconds); the second is False if there was no time left."""
    begin = time.time()
    if begin > end:
        return name, False, 0.0
    pattern = name
    for character in "\\,[]":
        pattern = pattern.replace(character, "\\" + character)
    try:
        done = subprocess.run([str(program), pattern], capture_output=True, env=env, timeout=LONGEST)
        fault = None if done.returncode == 0 else (done.stdout + done.stderr).decode(errors="replace")[-6000:]
    except subprocess.TimeoutExpired:
        fault = f"no end within {LONGEST} s"
    return name, fault, time.time() - begin


def run(program, specification, build, folder, jobs, end, say):
    """All test cases of the specification. Returns whether all that ran passed."""
    begin = time.time()
    names = names_of(program, specification)
    if not names:
        say(f"FAILED: {program.name} has no test of {specification}")
        return False
    env = environment(build, folder, folder / "stillhook")
    with concurrent.futures.ThreadPoolExecutor(jobs) as pool:
        results = list(pool.map(lambda name: run_one(program, name, end, env), names))
    failed = [(name, fault) for name, fault, _ in results if fault]
    left_out = sum(1 for _, fault, _ in results if fault is False)
    for name, fault in failed:
        say(f"FAILED: {program.name}: {name}")
        print(fault)
    slowest = max(results, key=lambda result: result[2])
    say(f"{program.name}: {len(names) - left_out - len(failed)} of {len(names)} tests passed, {len(failed)} failed"
        + (f", {left_out} LEFT OUT for want of time" if left_out else "")
        + f"; {time.time() - begin:.0f} s, the longest {slowest[2]:.0f} s ({slowest[0]})")
    return not failed
