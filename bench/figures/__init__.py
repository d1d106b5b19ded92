"""Figures of documents and reports: tables, plots and pictures from results of the benches and from the program."""
