"""Randomised looks and dynamics."""
