"""ptmcalc: dynamic design checks of material-handling machines written as YAML."""

__version__ = "0.1.0"
