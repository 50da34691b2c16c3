"""Machines that move alike: a search for a stronger chain repeats none of their runs."""

from ptmcalc.base.memory import forgotten_with, kept_for
from ptmcalc.machines.chain_drive.machine.spec import ChainDrive, Start

_KEPT = 16
"""Machines that are remembered; a numerical choice. Fewer repeat runs of a search, more take memory."""
_known: dict[tuple[str, str], tuple[ChainDrive, Start]] = {}
forgotten_with(_known.clear)


@kept_for(64)
def moving_alike(spec: ChainDrive, scene: Start) -> tuple[ChainDrive, Start]:
    """The first machine and scene that equal these, apart from the breaking load of the chain, which moves nothing.

    **Range** for tensions and motions; what is compared with the breaking load needs the machine itself.
    **Error** none.
    **Source** the breaking load enters no equation of motion.
    """
    key = repr(spec.model_dump(exclude={"chain": {"given_breaking_load"}})), repr(scene)
    if key not in _known:
        if len(_known) >= _KEPT:
            del _known[next(iter(_known))]
        _known[key] = spec, scene
    return _known[key]
