"""Completions in real shells, and the manual page under its readers: test_completions.py CLUSTERBENCH SHELL|man.
Exits 77 (skipped) without the shell."""

import os
import pty
import re
import select
import shutil
import subprocess
import sys
import tempfile
from concurrent.futures import ThreadPoolExecutor

SKIPPED = 77

# What is typed -> what must be offered, and what must not.
CASES = [
    ("clusterbench ", ["run", "export", "scene", "completion"], ["--help"]),
    ("clusterbench sch", ["schema"], ["scene"]),
    ("clusterbench scene ", ["info", "generate"], ["run"]),
    ("clusterbench scene generate ", ["street", "open-world"], ["info"]),
    ("clusterbench schema ", ["config", "result", "comparison", "stress", "worst-case", "light-map"], []),
    ("clusterbench light-map pl", ["plan.json"], []),
    ("clusterbench worst-case --measure ", ["entries", "longest", "p99"], ["plan.json"]),
    ("clusterbench worst-case --grid ", ["frustum", "world"], ["plan.json"]),
    ("clusterbench worst-case pl", ["plan.json"], []),
    ("clusterbench run --", ["--output", "--export", "--no-timing", "--count"], ["--format", "--count-dumps"]),
    ("clusterbench export r.json --format ", ["bencher", "google-benchmark", "markdown"], ["plan.json"]),
    ("clusterbench export r.json --format g", ["github-bigger"], ["csv"]),
    ("clusterbench run --export ", ["csv=", "lnt="], []),
    ("clusterbench run --count=", ["perf", "callgrind"], ["csv"]),
    ("clusterbench stress --cases H2", ["H2", "H22"], ["H1"]),
    ("clusterbench stress --methods ex", ["exact", "exact-fast"], ["aabb"]),
    ("clusterbench run --assigner exact-", ["exact-fast"], ["aabb"]),
    ("clusterbench run --grid ", ["frustum", "world"], ["plan.json"]),
    ("clusterbench run pl", ["plan.json"], []),
    ("clusterbench run -o out --filter x pl", ["plan.json"], []),
    ("clusterbench run --export csv=pl", ["plan.json"], []),
]


def offered_by_bash(script, line, folder):
    """Asks the function as readline does: words split at COMP_WORDBREAKS, an equals sign being one of them."""
    words = [word for word in re.split(r"(=)| ", line) if word]
    if line.endswith(" ") or not words:
        words.append("")
    ask = "source {}; COMP_WORDS=({}); COMP_CWORD={}; compopt() {{ :; }}; _clusterbench; printf '%s\\n' \"${{COMPREPLY[@]}}\"".format(
        script, " ".join("'" + word + "'" for word in words), len(words) - 1)
    done = subprocess.run(["bash", "--norc", "-c", ask], capture_output=True, text=True, cwd=folder, check=True)
    assert not done.stderr, done.stderr
    return done.stdout.split()


def offered_by_fish(script, line, folder):
    ask = "source {}; complete -C '{}'".format(script, line)
    done = subprocess.run(["fish", "--no-config", "-c", ask], capture_output=True, text=True, cwd=folder, check=True)
    assert not done.stderr, done.stderr
    return [answer.split("\t")[0].rpartition("=")[2] if "=" in line else answer.split("\t")[0]
            for answer in done.stdout.splitlines()]


class Terminal:
    """An interactive shell, typed into."""

    def __init__(self, command, folder):
        pid, self.file = pty.fork()
        if pid == 0:
            os.chdir(folder)
            os.environ.update(TERM="dumb", PS1="$ ", HISTFILE="/dev/null", COLUMNS="200")
            os.execvp(command[0], command)

    def type(self, text, seconds=1.0):
        """What the shell shows until it is silent for so long."""
        os.write(self.file, text.encode())
        shown = b""
        while select.select([self.file], [], [], seconds)[0]:
            try:
                shown += os.read(self.file, 65536)
            except OSError:
                break
        return shown.decode(errors="replace")


def offered_by_zsh(script, line, folder):
    """Mostly waits for silence."""
    shell = Terminal(["zsh", "-f", "-i"], folder)
    shell.type("autoload -U compinit; compinit -D -u; source {}; zstyle ':completion:*' list-prompt ''; "
               "setopt auto_list no_auto_menu no_list_beep; LISTMAX=1000; PROMPT='$ '; stty columns 200\n".format(script), 2.0)
    shown = shell.type(line + "\t\t", 1.5)
    os.close(shell.file)
    if "command not found" in shown or "_arguments:" in shown:
        raise AssertionError(shown)
    shown = re.sub(r"\x1b\[[0-9;?]*[A-Za-z]", " ", shown)
    shown = shown.replace(line, line[: line.rfind(" ") + 1], 1) if not line.endswith((" ", "=", "-")) else shown
    return [re.sub(r"^csv=(?=.)|^--count=(?=.)", "", word) for word in shown.split()]


def check_interactive_bash(script, folder):
    shell = Terminal(["bash", "--norc", "-i"], folder)
    shell.type("source {}\n".format(script))
    for line, after in [("clusterbench sch\t", "schema "), ("clusterbench run --count=ca\t", "--count=callgrind "),
                        ("clusterbench run --export csv=pl\t", "csv=plan.json"), ("clusterbench run --export ln\t", "lnt=")]:
        shown = shell.type(line, 0.7)
        assert after in shown, (line, shown)
        shell.type("\x15", 0.2)
    os.close(shell.file)


def check_shell(program, shell):
    offered = {"bash": offered_by_bash, "zsh": offered_by_zsh, "fish": offered_by_fish}[shell]
    with tempfile.TemporaryDirectory() as folder:
        open(os.path.join(folder, "plan.json"), "w", encoding="utf-8").close()
        script = os.path.join(folder, "script")
        with open(script, "w", encoding="utf-8") as file:
            subprocess.run([program, "completion", shell], stdout=file, check=True)
        wrong = []
        with ThreadPoolExecutor(max_workers=5) as pool:
            all_answers = list(pool.map(lambda case: offered(script, case[0], folder), CASES))
        for (line, needed, unwanted), answers in zip(CASES, all_answers):
            if shell == "zsh":  # lists a word without the suffix that it will add
                needed = [word.rstrip("=") for word in needed]
            wrong += ["'{}' does not offer {}: {}".format(line, word, answers) for word in needed if word not in answers]
            wrong += ["'{}' offers {}".format(line, word) for word in unwanted if word in answers]
        assert not wrong, "\n".join(wrong)
        if shell == "bash":
            check_interactive_bash(script, folder)


def check_man(program):
    page = subprocess.run([program, "man"], capture_output=True, text=True, check=True).stdout
    for part in ["--export", "scene generate", "EXIT STATUS", "google-benchmark"]:
        assert part.replace("-", "\\-") in page, part
    readers = [["man", "--warnings=all", "-l", "-"], ["mandoc", "-Tlint", "-W", "warning"]]
    readers = [reader for reader in readers if shutil.which(reader[0])]
    if not readers:
        print("skipped: neither man nor mandoc is installed")
        return SKIPPED
    for reader in readers:
        done = subprocess.run(reader, input=page, capture_output=True, text=True, check=False,
                              env={**os.environ, "MANPAGER": "cat", "MAN_KEEP_STDERR": "1", "LC_ALL": "C.UTF-8"})
        said = done.stderr + (done.stdout if reader[0] == "mandoc" else "")
        said = re.sub(r"mandoc: .*missing date.*\n", "", said)  # it has none, so that the same source gives the same page
        assert not said, (reader, said)
    return 0


def main():
    program, what = sys.argv[1:]
    if what == "man":
        return check_man(program)
    if not shutil.which(what):
        print("skipped: {} is not installed".format(what))
        return SKIPPED
    check_shell(program, what)
    return 0


if __name__ == "__main__":
    sys.exit(main())
