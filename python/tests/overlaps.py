"""Texts of a figure that lie on one another."""
from matplotlib.text import Text

# Overlaps up to this size are gaps between letters [pixel]
ROOM = 1.5


def texts_of(figure):
    """Texts that show: all but those of ticks beyond the limits of their axes."""
    hidden = set()
    for axes in figure.axes:
        for axis in axes._axis_map.values():
            scale = axis.get_transform()
            low, high = sorted(scale.transform(axis.get_view_interval()))
            room = 1e-9*(high - low)
            for tick in [*axis.get_major_ticks(), *axis.get_minor_ticks()]:
                if not low - room <= scale.transform([tick.get_loc()])[0] <= high + room:
                    hidden |= {tick.label1, tick.label2}
    return [one for one in figure.findobj(Text) if one.get_visible() and one.get_text().strip() and one not in hidden]


def overlaps(figure):
    """Pairs of different texts whose boxes overlap."""
    figure.canvas.draw()
    boxes = [(one.get_text(), Text.get_window_extent(one)) for one in texts_of(figure)]
    return [(name, other) for k, (name, a) in enumerate(boxes) for other, b in boxes[k + 1:]
            if name != other and min(a.x1, b.x1) - max(a.x0, b.x0) > ROOM and min(a.y1, b.y1) - max(a.y0, b.y0) > ROOM]
