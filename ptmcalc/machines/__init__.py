"""Floor 5: machine kinds, one folder each, independent of each other.

A kind is a package here that defines `KIND`, or an entry point of the group `ptmcalc.machines`. Kinds are found by
listing and imported only when named.
"""
