"""What any check must import: the libraries alone, and made ready for use, as scripts of a process of their own."""

LIBRARIES = "import typer, pydantic, yaml, rich, numpy"
READY = f"""{LIBRARIES}
class Model(pydantic.BaseModel):
    size: int = 1
Model()
app = typer.Typer(rich_markup_mode=None)
@app.command()
def command(size: int = 1) -> None: ...
try:
    app([])
except SystemExit:
    pass
"""
