"""Runs axijoint for tests. The environment variable AXIJOINT is the path of the program."""
import os
import pathlib
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path[:0] = [str(ROOT/"python"), str(ROOT/"test/decks")]


def run(folder, name, text, exit_code=0):
    """Run a deck, a text or its bytes, that ends with an exit code; returns the path of the results without ending."""
    deck = pathlib.Path(folder)/f"{name}.dat"
    deck.write_bytes(text if isinstance(text, bytes) else text.encode("utf-8"))
    done = subprocess.run([os.environ["AXIJOINT"], "run", deck, "-o", folder], capture_output=True,
                          text=True, check=False)
    if done.returncode != exit_code:
        raise RuntimeError(f"{deck}: exit code {done.returncode}\n{done.stderr}{done.stdout}")
    return pathlib.Path(folder)/name


def turned_monopile(theta):
    """Text of the deck of the monopile, pushed towards theta [degree]."""
    text = input_deck("monopile")
    for load in ("LATERAL       5.0", "MOMENT    -100.0"):
        name, value = load.split()
        text = text.replace(f"    1{name:>10}{value:>10}\n", f"1, {name}, {value}, {theta}\n")
    return text


def input_deck(name, *cards):
    """Text of a deck of `inputs`, with further cards before its END."""
    lines = (ROOT/f"inputs/{name}.dat").read_text().rstrip().splitlines()
    assert lines[-1] == "END"
    return "\n".join([*lines[:-1], *cards, "END", ""])
