"""`python -m ptmcalc` is the command line."""

from ptmcalc.cli.start import main

if __name__ == "__main__":
    main()
