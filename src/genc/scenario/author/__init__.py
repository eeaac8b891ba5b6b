"""Scenarios by a language model: seeds and their other wordings, layouts (Q1), events (Q2), each held to the rules.

Gen-C, Bootstrapping Crowd Scenarios via LLMs. What is asked stands in `prompts/*.md`.
"""
