"""What each approximation of a run leaves, as the summary says it: key `errors`."""
from .markup import joined, number, table, tag


def known(job):
    """Whether the summary of a run says it."""
    return bool(job.summary.get("errors"))


def errors(job):
    """The error budget as tables, whatever quantities it has."""
    return joined(_tables("Estimated errors", job.summary["errors"]))


def _tables(caption, value):
    """Tables of a value of JSON: of objects in an object or a list, of single values beside them."""
    if isinstance(value, list) and all(isinstance(one, dict) for one in value):
        yield _rows(caption, [("", one) for one in value])
        return
    if not isinstance(value, dict):
        yield tag("p", f"{caption}: {_cell(value)}")
        return
    groups = [(words(name), one) for name, one in value.items() if isinstance(one, dict) and _flat(one)]
    singles = [(words(name), one) for name, one in value.items() if not isinstance(one, (dict, list))
               or isinstance(one, list) and not any(isinstance(x, dict) for x in one)]
    if groups:
        yield _rows(caption, groups)
    if singles:
        yield table("" if groups else caption, ["", ""], [[name, _cell(one)] for name, one in singles],
                    named_rows=True)
    for name, one in value.items():
        nested = isinstance(one, dict) and not _flat(one) or isinstance(one, list) and any(
            isinstance(x, dict) for x in one)
        if nested:
            yield from _tables(words(name), one)


def _rows(caption, groups):
    """A row for each object, a column for each key."""
    keys = list(dict.fromkeys(key for _, one in groups for key in one))
    named = any(name for name, _ in groups)
    rows = [[*([name] if named else []), *(_cell(one.get(key)) for key in keys)] for name, one in groups]
    return table(caption, [*([""] if named else []), *map(words, keys)], rows, named_rows=named)


def _flat(one):
    return not any(isinstance(value, (dict, list)) for value in one.values())


def _cell(value):
    if isinstance(value, bool):
        return "yes" if value else "no"
    if isinstance(value, list):
        return ", ".join(number(x) if isinstance(x, (int, float)) else str(x) for x in value)
    return value


def words(name):
    """A key as words."""
    return name.replace("_", " ")
