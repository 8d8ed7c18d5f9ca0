"""Figures of studies: quantities against what varies."""
import numpy as np

from . import style
from .kinds import Kind, NothingToDraw
from .options import Options
from .style import plt

# What is drawn where no quantities are asked for
USUAL = ("largest_displacement", "largest_pressure", "largest_shear")
# Curves that can be told apart; rows from which a histogram tells something
MOST_CURVES, LEAST_SAMPLES = len(style.CURVES), 20


def quantities(study, options):
    """Names of the quantities to draw: those asked for, or the usual ones that vary."""
    for name in options.quantities or ():
        if name not in study.quantities:
            raise ValueError(f"there is no quantity {name!r}; there are {', '.join(study.quantities)}")
    if not study.solved.any():
        raise NothingToDraw("no row has exit code 0")
    found = options.quantities or [name for name in USUAL if np.ptp(study.rows[name][study.solved]) > 0]
    if not found:
        raise NothingToDraw(f"none of {', '.join(USUAL)} varies; name others with --quantities")
    return found


def varied(study, options, count):
    """Names of the columns to draw against: those asked for, or those of numbers with the most values."""
    names = [name for name in study.columns if study.rows[name].dtype == float
             and len(np.unique(study.rows[name][np.isfinite(study.rows[name])])) > 1]
    asked = [name.upper() for name in options.against or ()]
    for name in asked:
        if name not in names:
            raise ValueError(f"no column {name!r} of numbers varies; there are {', '.join(names) or 'none'}")
    found = (asked or sorted(names, key=lambda name: -len(np.unique(study.rows[name]))))[:count]
    if len(found) < count:
        raise NothingToDraw(f"{len(found)} columns of numbers vary, and {count} are wanted")
    return found


@style.styled
def draw_curves(study, options=Options()):
    """Quantities against a column: a curve for each combination of what else varies, points if there are many."""
    (against,), names = varied(study, options, 1), quantities(study, options)
    figure, axes = plt.subplots(len(names), 1, figsize=(4.6, 0.5 + 1.9*len(names)), sharex=True, squeeze=False)
    x = study.rows[against]
    curves = _curves(study, against)
    for one, name in zip(axes[:, 0], names):
        y = study.rows[name]
        if len(curves) > MOST_CURVES:
            one.plot(x[study.solved], y[study.solved], ls="", marker="o", ms=2.5, mfc="none", mew=0.6)
        else:
            for k, (label, rows) in enumerate(curves):
                rows = rows[np.argsort(x[rows], kind="stable")]
                one.plot(x[rows], np.where(study.solved, y, np.nan)[rows], label=label, **style.curve(k))
        _unsolved(one, x[~study.solved], np.zeros((~study.solved).sum()), one.get_xaxis_transform())
        one.set_ylabel(label_of(name))
        style.scaled(one, "y")
    axes[-1, 0].set_xlabel(against)
    if 1 < len(curves) <= MOST_CURVES:
        style.legend(figure, "right upper", *axes[0, 0].get_legend_handles_labels())
    _heading(figure, study, options)
    return figure


@style.styled
def draw_map(study, options=Options()):
    """Quantities over two columns: mean of the rows that have the same two values, which a line below says."""
    pair, names = varied(study, options, 2), quantities(study, options)
    figure, axes = plt.subplots(1, len(names), figsize=(0.6 + 2.6*len(names), 2.5), sharey=True, squeeze=False)
    x, y = (study.rows[name] for name in pair)
    for one, name in zip(axes[0], names):
        low, high = options.range or (None, None)
        look = {"vmin": low, "vmax": high}
        grid = _grid(study, x, y, study.rows[name])
        if grid is not None:
            drawn = one.pcolormesh(*grid, shading="nearest", **look)
            one.set_xticks(style.thinned(grid[0], 6))
            one.set_yticks(style.thinned(grid[1], 6))
        else:
            drawn = one.scatter(x[study.solved], y[study.solved], c=study.rows[name][study.solved], s=14, **look)
        _unsolved(one, x[~study.solved], y[~study.solved], one.transData)
        one.set_xlabel(pair[0])
        bar = figure.colorbar(drawn, ax=one, label=label_of(name), location="top")
        power = style.power_of(np.abs(drawn.get_clim()).max())
        bar.ax.xaxis.set_major_formatter(lambda value, _, power=power: f"{value/10.0**power:.6g}")
        bar.set_label(style.with_power(label_of(name), power))
        bar.ax.xaxis.set_major_locator(style.matplotlib.ticker.MaxNLocator(4))
    axes[0, 0].set_ylabel(pair[1])
    averaged = _averaged(study, pair)
    if grid is not None and averaged:
        figure.supxlabel(f"mean over {', '.join(averaged)}", fontsize=7, color="0.25")
    _heading(figure, study, options)
    return figure


@style.styled
def draw_histogram(study, options=Options()):
    """How often values of quantities are found among the rows with exit code 0."""
    names = quantities(study, options)
    figure, axes = plt.subplots(1, len(names), figsize=(0.4 + 2.4*len(names), 2.3), sharey=True, squeeze=False)
    for one, name in zip(axes[0], names):
        values = study.rows[name][study.solved]
        one.hist(values, bins="auto", range=options.range, color="0.8", edgecolor="0.35", lw=0.5)
        for value, dashes, label in ((values.mean(), "-", "mean"), (np.quantile(values, 0.05), "--", "5 % and 95 %"),
                                     (np.quantile(values, 0.95), "--", None)):
            one.axvline(value, color="black", ls=dashes, lw=0.9, label=label)
        one.set_xlabel(label_of(name))
        style.scaled(one, "x")
        one.xaxis.set_major_locator(style.matplotlib.ticker.MaxNLocator(4))
    axes[0, 0].set_ylabel("rows")
    style.legend(figure, "upper right", *axes[0, 0].get_legend_handles_labels(), ncols=2)
    _heading(figure, study, options, cross="")
    return figure


def label_of(name):
    """The name of a quantity in words."""
    return name.replace("_", " ")


def _curves(study, against):
    """Label and rows of each combination of the other columns' values, in the order of the table."""
    others, found = _others(study, (against,)), {}
    for k in range(study.rows.rows):
        values = [study.rows[name][k] for name in others]
        label = "\n".join(f"{name} = {value:g}" if isinstance(value, float) else f"{name} = {value}"
                          for name, value in zip(others, values))
        found.setdefault(label, []).append(k)
    return [(label, np.array(rows)) for label, rows in found.items()]


def _others(study, drawn):
    """Names of the columns that vary beside those that are drawn against."""
    return [name for name in study.columns if name not in drawn and len(set(map(str, study.rows[name]))) > 1]


def _averaged(study, pair):
    """Names of the columns that vary among solved rows which have the same two values."""
    same = list(zip(*(study.rows[name][study.solved] for name in pair)))
    return [name for name in _others(study, pair)
            if len(set(zip(same, map(str, study.rows[name][study.solved])))) > len(set(same))]


def _grid(study, x, y, values):
    """Values of both columns and means on their grid; None if the rows are not on one."""
    across, up = np.unique(x), np.unique(y)
    if np.isnan(across).any() or np.isnan(up).any() or len(across)*len(up) > 2*len(x):
        return None
    total, count = np.zeros((len(up), len(across))), np.zeros((len(up), len(across)))
    place = (np.searchsorted(up, y[study.solved]), np.searchsorted(across, x[study.solved]))
    np.add.at(total, place, values[study.solved])
    np.add.at(count, place, 1)
    with np.errstate(invalid="ignore"):
        return across, up, total/np.where(count > 0, count, np.nan)


def _unsolved(axes, x, y, transform):
    """Crosses for rows that are not solved."""
    if len(x):
        axes.plot(x, y, transform=transform, ls="", marker="x", color="black", ms=4, clip_on=False, zorder=3)


def _heading(figure, study, options, cross="× "):
    left_out = int((~study.solved).sum())
    words = f"{cross}{left_out} of {len(study.solved)} rows not solved" if left_out else ""
    if options.title is not None or words:
        figure.suptitle(options.title if options.title is not None else words, x=0.01, ha="left")


def _of(draw):
    return lambda name: lambda study, options: [(name, draw(study, options))]


def _sampled(study):
    """Whether a study has many rows, and values of their own in each."""
    return study.solved.sum() >= LEAST_SAMPLES and any(len(set(map(str, study.rows[name]))) == study.rows.rows
                                                       for name in study.columns)


def _several(count):
    def tells(study):
        try:
            varied(study, Options(), count)
        except NothingToDraw:
            return False
        return study.rows.rows > count
    return tells


KINDS = {
    "curves": Kind("quantities against a column, a curve for each state of the others", _of(draw_curves)("curves"),
                   ("quantities", "against"), tells=_several(1)),
    "map": Kind("quantities over two columns", _of(draw_map)("map"), ("quantities", "against", "range"),
                tells=_several(2)),
    "histogram": Kind("how often values are found; mean, 5 % and 95 %", _of(draw_histogram)("histogram"),
                      ("quantities", "range"), tells=_sampled)}
