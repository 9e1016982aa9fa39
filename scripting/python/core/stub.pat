# What nanobind does not see of the module for _core.pyi: its exceptions.
_core.__prefix__:
    __version__: str

    class Error(ValueError):
        where: str
        message: str
        hint: str

    class CatalogueError(Error): ...
