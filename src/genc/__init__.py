"""Generative crowds: one sentence in, a populated world out."""
