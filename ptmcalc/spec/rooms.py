"""Texts of a kind of machine that its topics share: one file in the folder of the kind, and one in that of each
topic."""

from collections.abc import Mapping


def texts_in(package: str, name: str) -> Mapping[str, str]:
    """The text of a file in the folder of a package and in each folder directly in it, by package; those without the
    file are not named."""
    from importlib import resources

    top = resources.files(package)
    rooms = sorted(one.name for one in top.iterdir() if one.is_dir() and one.name.isidentifier())
    places = {package: top.joinpath(name)} | {f"{package}.{room}": top.joinpath(room, name) for room in rooms}
    return {room: place.read_text("utf-8") for room, place in places.items() if place.is_file()}
