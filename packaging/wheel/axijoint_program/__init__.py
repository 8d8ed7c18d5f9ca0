"""The program axijoint, carried in the wheel with its libraries; `axijoint` on the command line starts it."""
import os
import sys

PATH = os.path.join(os.path.dirname(os.path.realpath(__file__)), "axijoint")


def main() -> None:
    """Become the program, with the arguments of this process"""
    os.execv(PATH, ["axijoint", *sys.argv[1:]])
