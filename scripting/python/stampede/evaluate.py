"""`evaluate` by the name of its first module."""

from .evaluation import evaluate

__all__ = ["evaluate"]
