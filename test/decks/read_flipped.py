"""Flips bits of an HDF5 file, one at a time, and reads all of it

Usage: read_flipped.py FILE COUNT

COUNT bits are flipped at equal distances, the first and the last byte among them. Prints those with which other values
are read without an error, and how many were noticed; exit code 1 if there are any, or if none was noticed.
"""
import sys

import digest


def main(path, count):
    """Exit code"""
    right = digest.digest(path)
    with open(path, 'rb') as file:
        whole = file.read()
    noticed, wrong = 0, []
    for k in range(count):
        place = k*(len(whole) - 1)//(count - 1)
        hurt = bytearray(whole)
        hurt[place] ^= 1 << k % 8
        with open(path + '.hurt', 'wb') as file:
            file.write(hurt)
        try:
            if digest.digest(path + '.hurt') != right:
                wrong.append(place)
        except Exception:  # whatever a reader says, it does not go on with a wrong value
            noticed += 1
    print(f'{noticed} of {count} flipped bits noticed; read without an error are other values with those of bytes {wrong}')
    return bool(wrong) or not noticed


if __name__ == '__main__':
    sys.exit(main(sys.argv[1], int(sys.argv[2])))
