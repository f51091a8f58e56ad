from cosim.files import OutputError as OutputError
from cosim.report.contents import Views as Views
from cosim.report.dataset import run_columns as run_columns
from cosim.report.dataset import trajectory_columns as trajectory_columns
from cosim.report.results import write_data as write_data
from cosim.report.results import write_results as write_results
from cosim.report.run_summary import summary as summary
