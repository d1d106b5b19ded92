"""Makes the tables, plots and pictures of documents and reports from results of the benches and from the program."""
